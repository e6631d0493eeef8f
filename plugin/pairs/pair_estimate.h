// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

namespace cairn::bullet {

/// What is known of a pair before anything is done for it in a step.
struct PairEstimate {
  double urgency = 0;             ///< the greater, the sooner it has to be brought up to date
  std::uint64_t operations = 0;   ///< what that is expected to take, contacts included
  bool canBeCarriedOver = false;  ///< what it said last may stand for a step more
  bool mayBeCut = false;          ///< it has no answer: nothing is lost if it gets none in this step either
  bool isUnanswered = false;      ///< nor anything else that still holds: it is looked at coarsely at least
  bool outrunsAnswers = false;    ///< an answer of this step will not hold in the next
  std::uint64_t operationsIfScarce = ~std::uint64_t{0};  ///< what it is at most where there is not enough for all
};

}  // namespace cairn::bullet
