// SPDX-License-Identifier: GPL-3.0-or-later
// Fast balls, continuous collision on, at a thin plate as the builder makes it: leaves that hold both its sides.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "built_shape.h"
#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test::ball_shots_test {
namespace {

constexpr std::uint32_t kSeed = 20027;
constexpr double kThickness = 0.05, kHalfThickness = kThickness / 2;

const std::shared_ptr<btCollisionShape>& plate() {
  static const std::shared_ptr<btCollisionShape> shape = builtShape(cuboid({2, 2, kThickness}, 8));
  return shape;
}

struct Balls {
  int through = 0, aside = 0;
};

// Straight down onto the plate at 30 to 130 m/s, by a tenth of a second after.
Balls shootBalls(btScalar radius, btScalar restitution) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  Balls balls;
  for (int i = 0; i < 100; ++i) {
    BulletWorld<> w;
    w.add(plate(), 0, btVector3(0, 0, 0)).setRestitution(restitution);
    const btScalar x = btScalar(0.3F * unit(random)), y = btScalar(0.3F * unit(random)), z = btScalar(3 + unit(random));
    btRigidBody& body = w.add(std::make_shared<btSphereShape>(radius), 1, btVector3(x, y, z));
    const btScalar speed = btScalar(80 + 50 * unit(random));
    body.setRestitution(restitution);
    body.setLinearVelocity(btVector3(0, 0, -speed));
    body.setCcdMotionThreshold(radius / 2);
    body.setCcdSweptSphereRadius(radius);
    bool isThrough = false, isAside = false;
    for (int step = 0; step < 12; ++step) {
      w.step();
      const btVector3 v = body.getLinearVelocity();
      isThrough = isThrough || body.getWorldTransform().getOrigin().z() < -btScalar(kHalfThickness);
      isAside = isAside || std::hypot(v.x(), v.y()) > speed / 10;
    }
    balls.through += isThrough ? 1 : 0;
    balls.aside += isAside ? 1 : 0;
  }
  return balls;
}

TEST(BallShots, AreNeitherTurnedAsideNorThroughAThinPlate) {
  for (const btScalar radius : {btScalar(0.1), btScalar(0.05)})
    for (const btScalar restitution : {btScalar(0), btScalar(0.55)}) {
      const Balls balls = shootBalls(radius, restitution);
      std::cout << "of 100 balls of " << radius << " m, restitution " << restitution << ": " << balls.aside
                << " turned aside, " << balls.through << " through\n";
      EXPECT_EQ(balls.through, 0) << "seed " << kSeed;
      EXPECT_LE(balls.aside, 2) << "seed " << kSeed;
    }
}

}  // namespace
}  // namespace cairn::test::ball_shots_test
