// SPDX-License-Identifier: Zlib
#include "queries/bullet_casts.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "memory/virtual_table.h"

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
  return keepsFunction<Ray, OtherRay>(callback) ? static_cast<btTriangleRaycastCallback*>(&callback) : nullptr;
}

btTriangleConvexcastCallback* asSweep(btTriangleCallback& callback) {
  return keepsFunction<Sweep, OtherSweep>(callback) ? static_cast<btTriangleConvexcastCallback*>(&callback) : nullptr;
}

}  // namespace cairn::bullet
