// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "dispatch/step_tuning.h"
#include "pairs/emission_pace.h"

namespace cairn::bullet {

/// How long this machine takes to ask meshes for a pair's contacts, learnt from the pairs of earlier steps: under a
/// deadline only those are asked that are expected to answer in time. What is stopped half-way has cost its time and
/// says nothing.
class MeshTime {
 public:
  /// Nanoseconds. `operations`: as expected of the pair, nothing where it was never asked.
  double expected(std::optional<std::uint64_t> operations) const {
    return pace_.expectedNanoseconds(operations.value_or(static_cast<std::uint64_t>(first_)));
  }
  /// A pair with that expectation was asked.
  void took(std::optional<std::uint64_t> operations, std::chrono::nanoseconds time) {
    pace_.finished(expected(operations), time);
    wasAsked_ = true;
  }
  /// What the first question took.
  void learnFirst(std::uint64_t operations) {
    first_ += step_tuning::kLearning * (static_cast<double>(operations) - first_);
  }
  /// There was too little time for one.
  void wasRefused() { wasRefused_ = true; }
  /// A disturbance must not keep meshes silent for ever.
  void endStep() {
    if (wasRefused_ && !wasAsked_) pace_.lower(step_tuning::kHope);
    pace_.endStep();
    wasAsked_ = wasRefused_ = false;
  }

 private:
  EmissionPace pace_{step_tuning::kMeshPace, step_tuning::kMeshWeight};
  double first_ = step_tuning::kFirstMeshOperations;
  bool wasAsked_ = false, wasRefused_ = false;
};

}  // namespace cairn::bullet
