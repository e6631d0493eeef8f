// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/cost_model.h"
#include "pairs/step_horizon.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Places the collider and starts or resumes its traversal. Contacts within the speculative distance plus `threshold`
/// (world length) are wanted. Knowledge about a shape that was replaced is forgotten first. `refresh`: which leaf pairs
/// of a cached answer are measured again. False, and no contacts, when the shapes are no longer a sphere-tree and
/// something it can meet.
bool begin(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
           const StepHorizon& horizon, btScalar threshold, RefreshPolicy refresh, Budget& budget,
           ContactScratch& scratch);

/// The pair as a priority sees it. Precondition: `begin` succeeded in this step.
ScheduledPair scheduled(TreePair& pair);
/// Reports that `operations` were charged for the pair, in this step or one before. Returns the cost of the complete
/// traversal if it has ended, else 0. Precondition: as for `scheduled`.
std::uint64_t charge(TreePair& pair, std::uint64_t operations);
/// Reserves the expected cost of finishing the pair, in place of its earlier reservation. Precondition: as for
/// `scheduled`.
void reserve(TreePair& pair, Budget& budget, const CostModel& cost);
/// Releases the pair's reservation; the pair need not be begun.
void cancelReservation(TreePair& pair, Budget& budget);

}  // namespace cairn::bullet
