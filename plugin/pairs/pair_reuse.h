// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// How the bodies of a pair stand that have hardly moved against each other since it was answered.
struct Unmoved {
  RelativePlacement placement;  ///< now
  float moved;                  ///< world length, since then
};

/// For a pair that triangles answered: whether what it said does as it is (`tuning::kReused`). Precondition: the
/// bodies are copied where they are.
std::optional<Unmoved> unmoved(const TreePair& pair);
/// The manifolds' points follow the bodies as they are. May call users' callbacks.
PairReport reuse(TreePair& pair, const Unmoved& still);

}  // namespace cairn::bullet
