// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cairn::bullet {

/// Nanoseconds that this machine needs for a pair, learnt from earlier steps. Refinement under a deadline uses it to
/// stop early enough. The expected time is proportional to the pair's operations plus a fixed weight for grouping and
/// writing.
class CostModel {
 public:
  CostModel() = default;
  /// `firstCost`: nanoseconds an operation, before anything was measured.
  explicit CostModel(double firstCost) : cost_(firstCost) {}
  /// `pairWeight`: the fixed share of a pair, in operations.
  CostModel(double firstCost, double pairWeight) : pairWeight_(pairWeight), cost_(firstCost) {}

  double expectedNanoseconds(std::uint64_t operations) const { return cost_ * weight(operations); }

  /// Reports that pairs with a total expectation of `expectedNanoseconds` were finished in `time`.
  void finished(double expectedNanoseconds, std::chrono::nanoseconds time, std::size_t pairs = 1) {
    pairs_ += pairs;
    expected_ += expectedNanoseconds;
    taken_ += static_cast<double>(time.count());
  }
  /// Learns from the pairs finished since the last call. The cost rises quickly and falls slowly. A single disturbed
  /// step counts for little, except the first, whose expectation was a guess. Steps with little work are counted
  /// together.
  void endStep() {
    if (pairs_ < kTellingPairs) return;
    const double error = std::min(taken_ / expected_, std::exchange(mostRise_, kMaxRise));
    cost_ *= error > 1 ? error : 1 + kForgetting * (error - 1);
    expected_ = taken_ = 0;
    pairs_ = 0;
  }
  /// Lowers the cost by a fraction `part`, where nothing can be learnt.
  void lower(double part) { cost_ *= 1 - part; }
  /// Raises the cost to at least that of `other`, for work that includes the other's.
  void raiseTo(const CostModel& other) { cost_ = std::max(cost_, other.cost_); }

 private:
  // Grouping, choosing and writing contacts takes as long as this many operations, whatever was measured.
  static constexpr double kPairWeight = 30;
  static constexpr double kForgetting = 0.05, kMaxRise = 1.25, kMaxFirstRise = 4;
  // Fewer pairs teach nothing: single errors raise the cost more than they lower it, until no pair fits
  // (`CostModel.IsNotDrivenUpByStepsOfFewPairs`).
  static constexpr std::size_t kTellingPairs = 32;
  // Nanoseconds an operation before anything was measured; chosen too high.
  static constexpr double kFirstCost = 50;

  double weight(std::uint64_t operations) const { return pairWeight_ + static_cast<double>(operations); }

  double pairWeight_ = kPairWeight;
  double cost_ = kFirstCost, mostRise_ = kMaxFirstRise;
  double expected_ = 0, taken_ = 0;  // nanoseconds, since the last lesson
  std::size_t pairs_ = 0;            // finished since then
};

}  // namespace cairn::bullet
