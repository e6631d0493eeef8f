// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

namespace cairn::bullet {

/// The expected cost and urgency of a pair, before any work in a step.
struct PairEstimate {
  double urgency = 0;             ///< pairs with greater urgency are refined first
  std::uint64_t operations = 0;   ///< expected cost, contacts included
  bool canBeCarriedOver = false;  ///< its last answer may stand for one more step
  bool mayBeCut = false;          ///< it has no answer, so nothing is lost without one in this step
  bool isUnanswered = false;      ///< it has neither an answer nor valid guards: it gets a coarse look at least
  bool outrunsAnswers = false;    ///< an answer of this step will not hold in the next
  std::uint64_t operationsIfScarce =
      ~std::uint64_t{0};  ///< upper bound of the cost where there is not enough for all pairs
};

}  // namespace cairn::bullet
