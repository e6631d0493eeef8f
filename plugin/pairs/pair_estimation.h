// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Estimates the pair's cost and urgency in this step; a culled pair needs nothing. `usualOperations`: the recent cost
/// of pairs. `isTimed`: the step has a deadline; then bodies on planes may wait too, however far they have moved.
/// `timeStep`: seconds. Precondition: the copied bodies are at their present poses.
void estimate(TreePair& pair, std::uint64_t usualOperations, bool isTimed, btScalar timeStep);

/// The pair as a priority sees it before any work. Precondition: as for `estimate`.
ScheduledPair describe(const TreePair& pair);

}  // namespace cairn::bullet
