// SPDX-License-Identifier: Zlib
#include "queries/bullet_casts.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "platform/virtual_table.h"

namespace cairn::bullet {

namespace {

struct Ray : btTriangleRaycastCallback {
  Ray() : btTriangleRaycastCallback(btVector3(0, 0, 0), btVector3(0, 0, 0)) {}
  btScalar reportHit(const btVector3&, btScalar fraction, int, int) override { return fraction; }
};
struct OtherRay final : Ray {
  void processTriangle(btVector3*, int, int) override {}
};

struct Sweep : btTriangleConvexcastCallback {
  Sweep()
      : btTriangleConvexcastCallback(nullptr, btTransform::getIdentity(), btTransform::getIdentity(),
                                     btTransform::getIdentity(), 0) {}
  btScalar reportHit(const btVector3&, const btVector3&, btScalar fraction, int, int) override { return fraction; }
};
struct OtherSweep final : Sweep {
  void processTriangle(btVector3*, int, int) override {}
};

// Whether the callback keeps Bullet's test of a triangle.
template <class Plain, class Other>
bool keepsFunction(const btTriangleCallback& callback) {
  static const KeptFunction function = [] {
    const Plain plain;
    const Other other;
    return KeptFunction(&plain, &other);
  }();
  return function.isKeptBy(&callback);
}

}  // namespace

btTriangleRaycastCallback* asRay(btTriangleCallback& callback) {
  return castTo<btTriangleRaycastCallback>(callback, keepsFunction<Ray, OtherRay>);
}

btTriangleConvexcastCallback* asSweep(btTriangleCallback& callback) {
  return castTo<btTriangleConvexcastCallback>(callback, keepsFunction<Sweep, OtherSweep>);
}

}  // namespace cairn::bullet
