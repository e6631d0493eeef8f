// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "dispatch/step_tuning.h"
#include "pairs/cost_model.h"

namespace cairn::bullet {

/// How long this machine takes to ask meshes for a pair's contacts, learnt from the pairs of earlier steps: under a
/// deadline only those are asked that are expected to answer in time. What is stopped half-way has cost its time and
/// says nothing.
class MeshTime {
 public:
  /// Nanoseconds. `operations`: as expected of the pair, nothing where it was never asked.
  double expected(std::optional<std::uint64_t> operations) const {
    return cost_.expectedNanoseconds(operations.value_or(static_cast<std::uint64_t>(firstOperations_)));
  }
  /// A pair with that expectation was asked.
  void took(std::optional<std::uint64_t> operations, std::chrono::nanoseconds time) {
    cost_.finished(expected(operations), time);
    (operations ? known_ : first_).wasAsked = true;
  }
  /// What the first question to a pair took.
  void learnFirst(std::uint64_t operations) {
    firstOperations_ += step_tuning::kLearning * (static_cast<double>(operations) - firstOperations_);
  }
  /// There was too little time for one.
  void wasRefused(bool isKnown) { (isKnown ? known_ : first_).wasRefused = true; }
  /// A disturbance must not keep meshes silent for ever, nor one that is larger than others.
  void endStep() {
    if (known_.isStarved()) cost_.lower(step_tuning::kHope);
    if (first_.isStarved()) firstOperations_ *= 1 - step_tuning::kHope;
    cost_.endStep();
    known_ = first_ = {};
  }

 private:
  // Questions of this step.
  struct Questions {
    bool wasAsked = false, wasRefused = false;
    bool isStarved() const { return wasRefused && !wasAsked; }
  };

  CostModel cost_{step_tuning::kMeshCost, step_tuning::kMeshWeight};
  double firstOperations_ = step_tuning::kFirstMeshOperations;
  Questions known_, first_;  // to pairs that were asked before, and to others
};

}  // namespace cairn::bullet
