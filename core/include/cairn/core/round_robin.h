// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/pair_memory.h"
#include "cairn/core/priority.h"

namespace cairn {

/// Round-robin over all unfinished pairs (Hubbard 1996): every pair advances breadth-first at the same pace. The pairs
/// stand in line over all steps: one that has had its turn goes back to the end. Pairs that have never been served, of
/// which nothing is known yet, have a line of their own and every other turn; so no pair starves under any budget that
/// lets one turn through.
class CAIRN_CORE_EXPORT RoundRobin final : public Priority {
 public:
  bool hasImportances() const override { return false; }
  void begin(std::span<const ScheduledPair> pairs) override;
  std::optional<std::size_t> next() override;
  void turnEnded(std::size_t pair, Progress progress) override;

 private:
  struct Ticket {
    std::uint64_t number = 0;  // 0: none yet
    bool wasServed = false;
  };
  void handOutTickets(std::span<const ScheduledPair> pairs);
  void interleaveNewcomers();

  PairMemory<Ticket> tickets_;
  std::uint64_t nextTicket_ = 1;
  std::vector<std::size_t> ring_, line_;  // unfinished pairs in serving order, and room to sort them
  bool newcomersTurn_ = true;
  std::size_t cursor_ = 0;
};

}  // namespace cairn
