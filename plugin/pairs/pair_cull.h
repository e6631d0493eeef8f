// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/step_horizon.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// True when there can be no contacts, because the bodies' spheres are apart, or nothing touched in an earlier step
/// and nothing moved far since, or `cullNonFinite`: the pair then has none, and needs no more work in this step.
/// Cheap. `alsoFromGround`: whether the sphere of a body above a plane or a terrain is looked at as well. Where
/// nothing is interrupted a traversal says it once for many steps, and pairs keep the order they always had.
bool cullSeparated(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                   bool alsoFromGround, const StepHorizon& horizon);
/// True when one of the bodies `isNonFinite`: the pair then forgets what it knew and has no contacts, as if settled.
bool cullNonFinite(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
/// Whether it has points of an earlier step between bodies of which one `isNonFinite` now. It may not be asked about in
/// this step: Bullet passes over children of compounds whose boxes are apart in the compound's frame, and leaves them
/// their points. Precondition: the bodies live.
bool isLeftOver(const TreePair& pair);
/// What that does to a pair of a broken body. Contacts end: users' callbacks are called.
void forgetNonFinite(TreePair& pair);

}  // namespace cairn::bullet
