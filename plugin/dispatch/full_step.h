// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "dispatch/step_state.h"
#include "dispatch/workers.h"
#include "pairs/pair_measure.h"

namespace cairn::bullet {

/// Answers the pairs of a step without a budget, all of them in full. Contacts are measured on the threads of Bullet's
/// task scheduler. The calling thread brings the manifolds up to date, and calls the user's callbacks, in the order of
/// the pairs: the same bits for any number of threads.
class FullStep {
 public:
  explicit FullStep(StepState& step) : step_(step) {}

  /// Precondition: the pairs are in their order, and the step ends when it is told.
  void answer();

 private:
  enum class Course : std::uint8_t { none, asked, carried, measured };

  struct Measured {
    Course course = Course::none;
    PairReport carried;
    PairAnswer answer;
    std::uint64_t operations = 0;
  };

  void answer(std::size_t first, std::size_t last);
  void prepare(std::size_t index);
  void measure(std::size_t index, ContactScratch& scratch);
  void write(std::size_t index);

  StepState& step_;
  Workers workers_;
  std::vector<Measured> measured_;  // by the pairs' places
};

}  // namespace cairn::bullet
