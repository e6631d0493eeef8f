// SPDX-License-Identifier: Zlib
#include "dispatch/ghost_pairs.h"

#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include "platform/virtual_table.h"

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

bool isGhostByTable(const btCollisionObject& object) {
  static const GhostFunctions functions = ofBullet();
  return functions.comes.isKeptBy(&object) || functions.goes.isKeptBy(&object);
}

}  // namespace

btOverlappingPairCache* ghostPairsOf(const btCollisionObject& object) {
  if ((object.getInternalType() & btCollisionObject::CO_GHOST_OBJECT) == 0) return nullptr;
  const auto* const ghost = castTo<const Ghost>(object, isGhostByTable);
  return ghost ? const_cast<Ghost*>(ghost)->getOverlappingPairCache() : nullptr;
}

}  // namespace cairn::bullet
