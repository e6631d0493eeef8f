// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/priority.h"
#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

class btDispatcher;

namespace cairn::bullet {

/// A step in which a pair has to wait for a later one.
struct CarryOverStep {
  btDispatcher& dispatcher;
  btManifoldResult& result;
  btScalar timeStep;  ///< seconds
  bool isLate;        ///< the time is up; what was said stays as it was where bodies hardly move
};

/// Whether what the pair said last serves better than what was resolved in this step: it is to be held, begun or not.
/// Of begun pairs only two trees': what stands in for the others sees more than their last contacts.
bool isBetterCarriedOver(const TreePair& pair);

/// The manifolds' points follow the bodies, and where the last answer no longer counts the spheres of whole bodies,
/// which may not approach further, stand in, or on a terrain or a plane a few of the body's points. See
/// docs/algorithms/narrow-phase.md. Precondition: `estimate` said it can be held, or it `isBetterCarriedOver`.
PairReport carryOver(TreePair& pair, const CarryOverStep& step);
/// Where it is seen, and how large: what statistics need. Precondition: held or carried over in this step.
ScheduledPair seen(const TreePair& pair);

}  // namespace cairn::bullet
