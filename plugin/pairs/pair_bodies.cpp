// SPDX-License-Identifier: Zlib
#include "pairs/pair_bodies.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace cairn::bullet {

namespace {

std::uint64_t broadphaseId(const btCollisionObjectWrapper& body) {
  const btBroadphaseProxy* proxy = body.getCollisionObject()->getBroadphaseHandle();
  return proxy ? static_cast<std::uint32_t>(proxy->getUid()) : 0;
}

}  // namespace

PairKey PairBodies::key(std::size_t arrival) const {
  const std::uint64_t uid0 = broadphaseId(body0()), uid1 = broadphaseId(body1());
  return {uid0 << 32 | uid1, std::uint64_t{childPath(body0())} << 32 | childPath(body1()), arrival};
}

}  // namespace cairn::bullet
