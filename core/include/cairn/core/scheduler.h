// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/traversal.h"

namespace cairn {

/// One pair of bodies in a step's narrow phase.
struct ScheduledPair {
  std::uint64_t id = 0;            ///< stable over steps and unique within one; breaks ties, never an address
  Traversal* traversal = nullptr;  ///< not owned
  float closingSpeed = 0;          ///< world length per second, >= 0
};

/// Decides which unfinished pair is refined next. A policy is told the pairs of a step, asked for turns, and told how
/// each ended; the same calls must give the same answers on every run.
class Priority {
 public:
  virtual ~Priority() = default;
  /// A new step: `pairs` ascend by id and live until the step ends. Finished traversals may be among them.
  virtual void begin(std::span<const ScheduledPair> pairs) = 0;
  /// Index of the pair to refine for one turn, or nothing when every pair is done.
  virtual std::optional<std::size_t> next() = 0;
  /// How the turn that `next` gave out ended.
  virtual void turnEnded(std::size_t pair, Progress progress) = 0;
};

/// Round-robin over all unfinished pairs (Hubbard 1996): every pair advances breadth-first at the same pace. The pairs
/// stand in line over all steps: one that has had its turn goes back to the end. Pairs that have never been served, of
/// which nothing is known yet, have a line of their own and every other turn; so no pair starves under any budget that
/// lets one turn through.
class RoundRobin final : public Priority {
 public:
  void begin(std::span<const ScheduledPair> pairs) override;
  std::optional<std::size_t> next() override;
  void turnEnded(std::size_t pair, Progress progress) override;

 private:
  struct Ticket {
    std::uint64_t id, number;
    bool wasServed;
  };
  void handOutTickets(std::span<const ScheduledPair> pairs);
  void interleaveNewcomers();

  std::vector<Ticket> tickets_, lastStep_;  // by id
  std::uint64_t nextTicket_ = 0;
  std::vector<std::size_t> ring_, line_;  // unfinished pairs in serving order, and room to sort them
  bool newcomersTurn_ = true;
  std::size_t cursor_ = 0;
};

/// Is told of every turn, to do something with what it resolved while that is in the cache. What this costs it books on
/// the budget itself, and may promise what is still to come.
class TurnListener {
 public:
  virtual ~TurnListener() = default;
  /// `pair` is the index in the pairs of this step. Traversals may be abandoned, none may be started.
  virtual void turnEnded(std::size_t pair, Progress progress, Budget& budget) = 0;
};

/// Shares one budget over all pairs of a step.
class Scheduler {
 public:
  /// Operations a pair may use before the next pair has its turn: about eight full families, long enough to amortise
  /// the switch, short enough that a hundred pairs all move within a ten-thousand-operation budget.
  static constexpr std::uint32_t kTurnOperations = 80;

  /// Refines until every pair is done or the budget is spent. `pairs` need not be sorted; they are sorted by id here.
  /// Precondition: ids unique, traversals started.
  Progress run(std::span<ScheduledPair> pairs, Priority& priority, Budget& budget, TurnListener* listener = nullptr);
};

}  // namespace cairn
