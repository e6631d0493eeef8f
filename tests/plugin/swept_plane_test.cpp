// SPDX-License-Identifier: Zlib
#include "continuous/swept_plane.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <gtest/gtest.h>

#include "placement/bullet_math.h"

namespace cairn::bullet::swept_plane_test {
namespace {

constexpr float kSizeOfAnything = 1e19F;  // a shape's largest

// Normals of a tree's leaves are asked as well, and a direction has components that are zero.
TEST(SweptPlane, ReachesBeyondEverythingAlongAllDirectionsButItsNormal) {
  const btStaticPlaneShape shape(btVector3(0, 0, 1), btScalar(2.5));
  SweptPlane plane;
  plane.take(shape, btVector3(0, 0, 0), btVector3(0, 0, 0));
  const Mat3 axes = toMat3(btMatrix3x3(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.7))));
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1), normalized(Vec3(1, 0, 1))}) {
    EXPECT_GT(dot(direction, plane.support(0, direction)), kSizeOfAnything);
    const Vec3 turned = axes * direction;
    EXPECT_GT(dot(turned, supportOf(plane, 0, axes, turned)), kSizeOfAnything);
  }
  EXPECT_EQ(plane.support(0, {0, 0, 1}), Vec3(0, 0, 2.5F));
}

}  // namespace
}  // namespace cairn::bullet::swept_plane_test
