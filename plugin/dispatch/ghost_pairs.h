// SPDX-License-Identifier: Zlib
#pragma once

class btCollisionObject;
class btOverlappingPairCache;

namespace cairn::bullet {

/// The pairs a `btPairCachingGhostObject` keeps for itself, or null of any other object. One derived from it is known
/// as long as it keeps how objects come or how they go.
btOverlappingPairCache* ghostPairsOf(const btCollisionObject& object);

}  // namespace cairn::bullet
