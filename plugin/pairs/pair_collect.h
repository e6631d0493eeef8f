// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Copies the bodies for a later answer. False when they are nested too deep for that.
bool collect(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
/// For pairs that are prepared before Bullet asks: moves the copies to the bodies' present poses. False when their
/// shapes have changed. Precondition: `collect` succeeded and the bodies live.
bool follow(TreePair& pair);

}  // namespace cairn::bullet
