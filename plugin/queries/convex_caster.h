// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>

namespace cairn::bullet {

/// Bullet's test of a triangle that also respects the callback's answer. A callback that returns the very fraction it
/// was given wants nothing farther.
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
