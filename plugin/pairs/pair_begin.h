// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/cost_model.h"
#include "pairs/step_horizon.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Places the collider and starts or resumes its traversal. `threshold` (world length): contacts this far apart are
/// wanted, beyond the speculative distance. When a shape was replaced, what is known of the old one is forgotten first.
/// `refresh`: of an answer that is kept. False, and no contacts, when the shapes are no longer a sphere-tree and
/// something it can meet.
bool begin(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
           const StepHorizon& horizon, btScalar threshold, RefreshPolicy refresh, Budget& budget,
           ContactScratch& scratch);

/// What a priority is told. Precondition: `begin` succeeded in this step.
ScheduledPair scheduled(TreePair& pair);
/// So much was charged for the pair, in this step or one before. What a whole traversal took, where it has ended; else
/// 0. Precondition: as for `scheduled`.
std::uint64_t charge(TreePair& pair, std::uint64_t operations);
/// Holds back what finishing the pair would take now, in place of what was held back for it before. Precondition: as
/// for `scheduled`.
void reserve(TreePair& pair, Budget& budget, const CostModel& cost);
/// Begun or not.
void cancelReservation(TreePair& pair, Budget& budget);

}  // namespace cairn::bullet
