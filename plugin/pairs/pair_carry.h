// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// How the bodies of a pair stand that have hardly moved against each other since it was answered.
struct StandsStill {
  RelativePlacement placement;  ///< now
  float moved;                  ///< world length, since then
};

/// For a pair that triangles answered: whether what it said does as it is (`tuning::kCarried`). Precondition: the
/// bodies are copied where they are.
std::optional<StandsStill> standsStill(const TreePair& pair);
/// The manifolds' points follow the bodies as they are. May call users' callbacks.
PairReport carryOver(TreePair& pair, const StandsStill& still);

}  // namespace cairn::bullet
