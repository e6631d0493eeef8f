// SPDX-License-Identifier: GPL-3.0-or-later
// Tilted boxes, continuous collision on, thrown straight down at a smooth plate without friction: nothing there can
// push them aside, and nothing is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "built_shape.h"
#include "bullet_world.h"
#include "test_solids.h"
#include "triangle_grounds.h"

namespace cairn::test::box_shots_test {
namespace {

constexpr std::uint32_t kSeed = 20052;
constexpr int kCount = 60, kSteps = 36;
constexpr double kThickness = 0.5;
constexpr btScalar kHalf = 0.5F, kSpeed = 20;

struct Bounce {
  double aside = 0, energy = 0;  // means, parts of the speed and energy they came with
  int through = 0;
};

Solid plate() {
  return cuboid({4, 4, kThickness}, 8);
}

Bounce throwBoxes(const std::shared_ptr<btCollisionShape>& ground) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  Bounce bounce;
  for (int i = 0; i < kCount; ++i) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(ground, 0, btVector3(0, 0, -btScalar(kThickness) / 2)).setRestitution(1);
    const btScalar a = unit(random), b = unit(random), c = unit(random), d = unit(random);
    const btVector3 where(btScalar(0.3) * unit(random), btScalar(0.3) * unit(random), btScalar(1.5));
    btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(kHalf, kHalf, kHalf)), 1, where,
                             btQuaternion(a, b, c, d).normalized());
    box.setRestitution(1);
    box.setFriction(0);
    box.setLinearVelocity(btVector3(0, 0, -kSpeed));
    box.setCcdMotionThreshold(kHalf / 2);
    box.setCcdSweptSphereRadius(kHalf / 2);
    w.step(kSteps);
    const btVector3 v = box.getLinearVelocity(), spin = box.getAngularVelocity();
    const double inertia = 4 * kHalf * kHalf / 6;
    bounce.aside += std::hypot(v.x(), v.y()) / kSpeed / kCount;
    bounce.energy += (v.length2() + inertia * spin.length2()) / (kSpeed * kSpeed) / kCount;
    bounce.through += box.getWorldTransform().getOrigin().z() < 0 ? 1 : 0;
  }
  return bounce;
}

TEST(BoxShots, TiltedOnesKeepTheirEnergyAndGoLessAsideThanOnBulletsMesh) {
  const Bounce onTree = throwBoxes(builtShape(plate()));
  const Bounce onMesh = throwBoxes(bvhMesh(plate()));
  std::cout << "tilted boxes go aside at " << onTree.aside << " of their speed, on Bullet's mesh " << onMesh.aside
            << "; keep " << onTree.energy << " of their energy, there " << onMesh.energy << "\n";
  EXPECT_EQ(onTree.through, 0) << "seed " << kSeed;
  EXPECT_LT(onTree.aside, onMesh.aside);
  EXPECT_NEAR(onTree.energy, 1, 0.05);
}

}  // namespace
}  // namespace cairn::test::box_shots_test
