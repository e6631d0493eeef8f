// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/priority.h"
#include "cairn/core/rank_heap.h"
#include "cairn/core/waiting_line.h"

namespace cairn {

/// Serves the pair with the greatest rank, `weight x error x (1 + age)`, and keeps everybody served:
///
/// * *Guaranteed minimum*: every other turn goes to the pair that has waited longest, whatever its rank. Turns are
///   counted over all steps, so a pair with n - 1 others has its turn within 2 n turns, under any budget that lets one
///   through a step.
/// * *Ageing*: age is the number of steps that went by without a turn for the pair.
/// * *Ties*: who has waited longer first; of those that are new, the smaller id.
///
/// A turn costs O(log n) and what `error` costs; beginning a step O(n log n). Ranks are IEEE arithmetic on what the
/// pairs say, in one order: the same calls give the same bits.
class CAIRN_CORE_EXPORT RankedPriority : public Priority {
 public:
  /// One turn in so many goes to the pair that has waited longest.
  static constexpr std::uint64_t kTurnsToLine = 2;

  void begin(std::span<const ScheduledPair> pairs) final;
  std::optional<std::size_t> next() final;
  void turnEnded(std::size_t pair, Progress progress) final;

 protected:
  /// Before the weights of a step are asked for.
  virtual void beginWeights(std::span<const ScheduledPair> /*pairs*/) {}
  /// The part of a pair's rank that is constant within a step, >= 0. It is asked once for each unfinished pair.
  virtual double weight(const ScheduledPair& pair) const = 0;
  /// The part of a pair's rank that a turn may change, >= 0: the certified error of its answer, world length. That is
  /// the error of its front or of its fallback, whichever is worse. A pair with NaN has no rank.
  virtual double error(const ScheduledPair& pair);

 private:
  RankHeap::Entry entryOf(std::size_t pair);

  std::span<const ScheduledPair> pairs_;
  std::vector<double> weights_;
  WaitingLine line_;
  RankHeap heap_;
  std::uint64_t turns_ = 0;
};

}  // namespace cairn
