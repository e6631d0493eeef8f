// SPDX-License-Identifier: Zlib
#pragma once

class btCollisionObject;
class btOverlappingPairCache;

namespace cairn::bullet {

/// The pairs that a `btPairCachingGhostObject` keeps for itself; null for any other object. Without type
/// information, a class derived from it is recognised unless it overrides both the adding and the removing of objects.
btOverlappingPairCache* ghostPairsOf(const btCollisionObject& object);

}  // namespace cairn::bullet
