// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Copies the bodies for a deferred answer; false when they are nested too deep for that.
bool collect(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
/// For pairs whose answer is not deferred but prepared: takes the copies to where the bodies are now (false when
/// their shapes have changed). Precondition: `collect` succeeded; the bodies live.
bool follow(TreePair& pair);

}  // namespace cairn::bullet
