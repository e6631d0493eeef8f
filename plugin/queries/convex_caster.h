// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>

namespace cairn::bullet {

/// Bullet's test of a triangle, with an ear for what the callback answers: a return of the very fraction that was
/// reported says that nothing farther is wanted.
class ConvexCaster final : public btTriangleConvexcastCallback {
 public:
  explicit ConvexCaster(btTriangleConvexcastCallback& callback)
      : btTriangleConvexcastCallback(callback.m_convexShape, callback.m_convexShapeFrom, callback.m_convexShapeTo,
                                     callback.m_triangleToWorld, callback.m_triangleCollisionMargin),
        callback_(callback) {
    m_hitFraction = callback.m_hitFraction;
    m_allowedPenetration = callback.m_allowedPenetration;
  }
  btScalar reportHit(const btVector3& normal, const btVector3& point, btScalar fraction, int part,
                     int triangle) override {
    const btScalar answer = callback_.reportHit(normal, point, fraction, part, triangle);
    if (answer == fraction) m_hitFraction = std::min(m_hitFraction, fraction);
    return answer;
  }

 private:
  btTriangleConvexcastCallback& callback_;
};

}  // namespace cairn::bullet
