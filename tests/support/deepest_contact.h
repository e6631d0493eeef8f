// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace cairn::test {

/// Of a contact query, the lowest gap told, metres; 1 where nothing is told.
struct DeepestContact final : btCollisionWorld::ContactResultCallback {
  btScalar separation = 1;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    separation = btMin(separation, point.getDistance());
    return 0;
  }
};

}  // namespace cairn::test
