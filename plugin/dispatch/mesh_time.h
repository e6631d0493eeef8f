// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "dispatch/step_tuning.h"
#include "pairs/cost_model.h"

namespace cairn::bullet {

/// Learns how long this machine needs to find a pair's contacts on meshes. Under a deadline only pairs are asked that
/// are expected to finish in time, because an interrupted question has no result.
class MeshTime {
 public:
  /// Expected nanoseconds. `operations`: as expected of the pair; nothing where it was never asked.
  double expected(std::optional<std::uint64_t> operations) const {
    return cost_.expectedNanoseconds(operations.value_or(static_cast<std::uint64_t>(firstOperations_)));
  }
  /// A pair with this expectation was asked.
  void took(std::optional<std::uint64_t> operations, std::chrono::nanoseconds time) {
    cost_.finished(expected(operations), time);
    (operations ? known_ : first_).wasAsked = true;
  }
  /// A pair's first question took this many operations.
  void learnFirst(std::uint64_t operations) {
    firstOperations_ += step_tuning::kLearning * (static_cast<double>(operations) - firstOperations_);
  }
  /// A pair was not asked for lack of time.
  void wasRefused(bool isKnown) { (isKnown ? known_ : first_).wasRefused = true; }
  /// Lowers expectations in steps that asked nobody, so that one disturbance does not keep meshes from being asked for
  /// ever.
  void endStep() {
    if (known_.isStarved()) cost_.lower(step_tuning::kHope);
    if (first_.isStarved()) firstOperations_ *= 1 - step_tuning::kHope;
    cost_.endStep();
    known_ = first_ = {};
  }

 private:
  // The questions of this step.
  struct Questions {
    bool wasAsked = false, wasRefused = false;
    bool isStarved() const { return wasRefused && !wasAsked; }
  };

  CostModel cost_{step_tuning::kMeshCost, step_tuning::kMeshWeight};
  double firstOperations_ = step_tuning::kFirstMeshOperations;
  Questions known_, first_;  // to pairs that were asked before, and to all others
};

}  // namespace cairn::bullet
