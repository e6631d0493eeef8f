// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Finds what the pair needs in this step; a settled one needs nothing. `usualOperations`: what pairs
/// were resolved with lately. `isTimed`: whether the step ends at a time; then bodies on planes can wait as well,
/// however far they have moved. `timeStep`: seconds. Precondition: the bodies are copied where they are.
void estimate(TreePair& pair, std::uint64_t usualOperations, bool isTimed, btScalar timeStep);

/// What a priority is told before anything is done for it. Precondition: as for `estimate`.
ScheduledPair describe(const TreePair& pair);

}  // namespace cairn::bullet
