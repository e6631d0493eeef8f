// SPDX-License-Identifier: Zlib
#include "dispatch/ghost_pairs.h"

#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include "memory/virtual_table.h"

namespace cairn::bullet {

namespace {

using Ghost = btPairCachingGhostObject;

struct Plain final : Ghost {};
struct ComesElsewise final : Ghost {
  void addOverlappingObjectInternal(btBroadphaseProxy*, btBroadphaseProxy*) override {}
};
struct GoesElsewise final : Ghost {
  void removeOverlappingObjectInternal(btBroadphaseProxy*, btDispatcher*, btBroadphaseProxy*) override {}
};

struct GhostFunctions {
  KeptFunction comes, goes;
};

GhostFunctions ofBullet() {
  const Plain plain;
  const ComesElsewise coming;
  const GoesElsewise going;
  return {KeptFunction(&plain, &coming), KeptFunction(&plain, &going)};
}

}  // namespace

btOverlappingPairCache* ghostPairsOf(const btCollisionObject& object) {
  if ((object.getInternalType() & btCollisionObject::CO_GHOST_OBJECT) == 0) return nullptr;
  static const GhostFunctions functions = ofBullet();
  if (!functions.comes.isKeptBy(&object) && !functions.goes.isKeptBy(&object)) return nullptr;
  return const_cast<Ghost&>(static_cast<const Ghost&>(object)).getOverlappingPairCache();
}

}  // namespace cairn::bullet
