// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that fall straight down onto a smooth flat tree, continuous collision on, and do not bounce: nothing there can
// send them aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "built_shape.h"
#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test::straight_down_test {
namespace {

constexpr std::uint32_t kSeed = 20056;
constexpr int kCount = 40, kSteps = 30;
constexpr btScalar kSpeed = 12;

struct Aside {
  double mean = 0, most = 0;  // parts of the speed
  int through = 0;
};

Aside drop(const std::shared_ptr<btCollisionShape>& ground, btScalar height,
           const std::shared_ptr<btCollisionShape>& shape) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto draw = [&] { return btScalar(unit(random)); };
  Aside aside;
  for (int i = 0; i < kCount; ++i) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(ground, 0, btVector3(0, 0, 0)).setFriction(0);
    const btScalar a = draw(), b = draw(), c = draw(), d = draw(), x = draw(), y = draw(), z = draw();
    btRigidBody& body = w.add(shape, 1, btVector3(2 * x, 2 * y, height + btScalar(1.6) + z * btScalar(0.4)),
                              btQuaternion(a, b, c, d).normalized());
    body.setFriction(0);
    body.setLinearVelocity(btVector3(0, 0, -kSpeed));
    body.setAngularVelocity(btVector3(a, b, c) * (i % 2 == 0 ? 0 : 6));
    body.setCcdMotionThreshold(btScalar(0.1));
    w.step(kSteps);
    const btVector3 v = body.getLinearVelocity();
    const double sideways = double(std::hypot(v.x(), v.y()) / kSpeed);
    aside.mean += sideways / kCount;
    aside.most = std::max(aside.most, sideways);
    aside.through += body.getWorldTransform().getOrigin().z() < height ? 1 : 0;
  }
  return aside;
}

TEST(StraightDown, NothingIsSentAsideByATree) {
  const struct {
    const char* name;
    Solid solid;
    btScalar height;
  } grounds[] = {{"a block of one cell", cuboid({20, 10, 1}, 1), btScalar(0.5)},
                 {"a block of cells of a metre", cuboid({12, 12, 1}, 12), btScalar(0.5)}};
  for (const auto& ground : grounds) {
    const auto groundShape = builtShape(ground.solid);
    for (const auto& [name, solid] : {std::pair{"torus", torus(0.5, 0.15, 24)}, {"ball", ball(0.5, 3)}}) {
      const Aside aside = drop(groundShape, ground.height, builtShape(solid));
      std::cout << "a " << name << " on " << ground.name << " goes aside at " << aside.mean << " of its speed, "
                << aside.most << " at most\n";
      EXPECT_EQ(aside.through, 0) << "seed " << kSeed;
      EXPECT_LT(aside.mean, 0.01) << "seed " << kSeed;
    }
  }
}

}  // namespace
}  // namespace cairn::test::straight_down_test
