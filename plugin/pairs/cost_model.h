// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cairn::bullet {

/// How long this machine takes to make a pair's contacts out of what its traversal resolved: learnt from the pairs of
/// earlier steps, so that refinement under a deadline stops early enough. A pair is expected to take as long as its
/// operations and a fixed share for grouping and writing together weigh.
class CostModel {
 public:
  CostModel() = default;
  /// For work that is known to be quicker or slower: nanoseconds an operation before anything was seen.
  explicit CostModel(double firstCost) : cost_(firstCost) {}
  /// And of which a pair takes as long as so many operations, however few it has.
  CostModel(double firstCost, double pairWeight) : pairWeight_(pairWeight), cost_(firstCost) {}

  double expectedNanoseconds(std::uint64_t operations) const { return cost_ * weight(operations); }

  /// A pair that had been expected to take `expectedNanoseconds` was finished in `time`; or several together.
  void finished(double expectedNanoseconds, std::chrono::nanoseconds time, std::size_t pairs = 1) {
    pairs_ += pairs;
    expected_ += expectedNanoseconds;
    taken_ += static_cast<double>(time.count());
  }
  /// Learns from the pairs finished since the last call: quickly that they take longer, slowly that they take less. One
  /// step that was disturbed counts for little, but for the first: what was expected of that was a guess. Steps in
  /// which little is done count together.
  void endStep() {
    if (pairs_ < kTellingPairs) return;
    const double error = std::min(taken_ / expected_, std::exchange(mostRise_, kMaxRise));
    cost_ *= error > 1 ? error : 1 + kForgetting * (error - 1);
    expected_ = taken_ = 0;
    pairs_ = 0;
  }
  /// By that part of itself, where nothing can be learnt.
  void lower(double part) { cost_ *= 1 - part; }
  /// What does more than `other` does not take less.
  void raiseTo(const CostModel& other) { cost_ = std::max(cost_, other.cost_); }

 private:
  // Grouping, choosing and writing what was measured takes as long as so many operations do, whatever was measured.
  static constexpr double kPairWeight = 30;
  static constexpr double kForgetting = 0.05, kMaxRise = 1.25, kMaxFirstRise = 4;
  // Of fewer pairs nothing is learnt. Errors of single pairs raise more than they lower: they would drive the pace up
  // until nothing fits (`CostModel.IsNotDrivenUpByStepsOfFewPairs`).
  static constexpr std::size_t kTellingPairs = 32;
  // Nanoseconds an operation before anything was seen: rather too many.
  static constexpr double kFirstCost = 50;

  double weight(std::uint64_t operations) const { return pairWeight_ + static_cast<double>(operations); }

  double pairWeight_ = kPairWeight;
  double cost_ = kFirstCost, mostRise_ = kMaxFirstRise;
  double expected_ = 0, taken_ = 0;  // nanoseconds, since it last learnt
  std::size_t pairs_ = 0;            // since then
};

}  // namespace cairn::bullet
