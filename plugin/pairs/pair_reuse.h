// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// The poses of a pair whose bodies have hardly moved against each other since it was answered.
struct Unmoved {
  RelativePlacement placement;  ///< now
  float moved;                  ///< world length, since the answer
};

/// Whether a pair that triangles answered may keep its contacts (`tuning::kReused`). Precondition: the copied bodies
/// are at their present poses.
std::optional<Unmoved> unmoved(const TreePair& pair);
/// Keeps the contacts; the manifolds' points follow the bodies. May call users' callbacks.
PairReport reuse(TreePair& pair, const Unmoved& still);

}  // namespace cairn::bullet
