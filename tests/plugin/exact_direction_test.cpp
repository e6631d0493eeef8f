// SPDX-License-Identifier: Zlib
// A leaf may hold both sides of a body. No contact of the meshes goes through the body.
#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::exact_direction_test {
namespace {

struct Deepest final : btCollisionWorld::ContactResultCallback {
  btScalar depth = 0;
  btVector3 normal{0, 0, 0};
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    if (-point.getDistance() > depth) {
      depth = -point.getDistance();
      normal = point.m_normalWorldOnB;
    }
    return 0;
  }
};

// Triangles a leaf.
class BoxOnItsTwin : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Leaves, BoxOnItsTwin, testing::Values(2U, 4U, 8U, 16U));

//    .--------.
//   /   up   /|   a little turned, tilted and aside, a little in the lower one
//  |--------|/
//  /  low  /|
// |-------|/
TEST_P(BoxOnItsTwin, IsNoDeeperThanItLies) {
  constexpr unsigned kSeed = 3;
  constexpr int kPoses = 500;
  constexpr double kTilt = 0.01, kHeight = 0.5;
  BulletWorld<> w;
  // In the body's frame axes go from the least moment to the greatest, as in the mesh.
  const auto shape = treeShape(plainTree(cuboid({2, 1, kHeight}, 3), GetParam()));
  btRigidBody &low = w.add(shape, 0, btVector3(0, 0, 0)), &up = w.add(shape, 0, btVector3(0, 0, 5));
  const auto deepest = [&](bullet::Finest finest) {
    w.dispatcher.setFinest(finest);
    Deepest point;
    w.world.contactPairTest(&low, &up, point);
    return point;
  };
  const double size = shape->size();
  // A corner of a tilted box is lower than its middle by so much, and a point may be told ahead by the other.
  const double slack = kTilt * size / 2 + double(bullet::kSpeculativeFraction) * size;
  std::mt19937_64 engine(kSeed);
  for (int pose = 0; pose < kPoses; ++pose) {
    const double depth = uniform(engine, 0, 0.004 * size), aside = uniform(engine, -0.3, 0.3);
    const btQuaternion turn(btVector3(0, 0, 1), btScalar(uniform(engine, 0, 6.28)));
    const btQuaternion tilt(btVector3(1, 0, 0), btScalar(uniform(engine, -kTilt, kTilt)));
    up.setWorldTransform(
        btTransform(turn * tilt, btVector3(btScalar(aside), btScalar(-aside), btScalar(kHeight - depth))));
    const Deepest exact = deepest(bullet::Finest::triangles);
    EXPECT_GE(double(exact.depth), depth - slack) << "seed " << kSeed << ", pose " << pose;
    EXPECT_LE(double(exact.depth), depth + slack)
        << "seed " << kSeed << ", pose " << pose << ", along " << exact.normal.x() << ' ' << exact.normal.y() << ' '
        << exact.normal.z();
  }
}

}  // namespace
}  // namespace cairn::test::exact_direction_test
