// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

class btDispatcher;

namespace cairn::bullet {

/// A step that has no time for a pair, so that the pair waits for a later one.
struct CarryOverStep {
  btDispatcher& dispatcher;
  btManifoldResult& result;
  btScalar timeStep;  ///< seconds
  bool isLate;        ///< the deadline has passed: contacts of bodies that hardly move stay as they are
};

/// Whether the pair's last answer is better than the result of this step, so that it is carried over. Among begun pairs
/// this holds only for two trees: the fallback of other pairs sees more than their last contacts.
bool isBetterCarriedOver(const TreePair& pair);

/// Carries the pair over: its manifolds' points follow the bodies. Where the last answer no longer counts, a fallback
/// answers: guards of the root spheres, or on terrains and planes some points of the body. See
/// docs/algorithms/narrow-phase.md. Precondition: the estimate allows it, or `isBetterCarriedOver`.
PairReport carryOver(TreePair& pair, const CarryOverStep& step);
/// The pair as a viewer sees it, for statistics. Precondition: carried over or reused in this step.
ScheduledPair seen(const TreePair& pair);

}  // namespace cairn::bullet
