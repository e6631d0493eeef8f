// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/step_horizon.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// True when there can be no contacts: the bounding spheres are separated, or cached separations exclude contacts, or a
/// body is non-finite. The pair then has no contacts and needs no more work in this step. Cheap. `alsoFromGround`:
/// tests also the sphere of a body above a plane or a terrain. Without a budget this is off, because a traversal
/// excludes contacts for many steps at once.
bool cullSeparated(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                   bool alsoFromGround, const StepHorizon& horizon);
/// True when one of the bodies `isNonFinite`. The pair then forgets its knowledge and has no contacts.
bool cullNonFinite(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
/// Whether the pair has points of an earlier step and a body that `isNonFinite` now. Bullet may not ask about such a
/// pair: it passes over children of compounds with separated boxes and keeps their points. Precondition: the bodies
/// live.
bool isLeftOver(const TreePair& pair);
/// Ends the contacts of a pair with a non-finite body. Calls users' callbacks.
void forgetNonFinite(TreePair& pair);

}  // namespace cairn::bullet
