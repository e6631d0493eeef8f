// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes that lie in a smooth flat floor already, set down or pressed into it, continuous collision on: the floor's
// inner edges are no obstacles, and what swings up out of it is not pushed back. Nothing there can change a sideways
// speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "built_shape.h"
#include "bullet_world.h"
#include "test_solids.h"
#include "triangle_grounds.h"

namespace cairn::test::set_down_test {
namespace {

constexpr std::uint32_t kSeed = 20053;
constexpr int kCount = 40;
constexpr double kThickness = 0.5;

const Solid& box() {
  static const Solid solid = cuboid({1, 0.7, 0.5}, 4);
  return solid;
}
Solid plate() {
  return cuboid({24, 12, kThickness}, 16);
}

struct Kept {
  double speed = 0, energy = 0;  // means, parts of what they had
  double mostEnergy = 0;
};

double energyOf(const btRigidBody& body) {
  const btVector3 spin = body.getAngularVelocity() * body.getWorldTransform().getBasis();
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  double energy = body.getLinearVelocity().length2();
  for (int i = 0; i < 3; ++i) energy += spin[i] * spin[i] / inverse[i];
  return energy;
}

// Boxes of a tree on a smooth ground, each put there by `place`, moved by `start`, and followed for some steps; `place`
// and `start` draw from the same random numbers.
template <class Place, class Start>
Kept follow(const std::shared_ptr<btCollisionShape>& ground, btScalar restitution, int steps, const Place& place,
            const Start& start) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto draw = [&] { return btScalar(unit(random)); };
  const std::shared_ptr<btCollisionShape> shape = builtShape(box());
  Kept kept;
  for (int i = 0; i < kCount; ++i) {
    BulletWorld<> w;
    btRigidBody& floor = w.add(ground, 0, btVector3(0, 0, -btScalar(kThickness) / 2));
    floor.setRestitution(1);
    const btTransform at = place(draw);
    btRigidBody& body = w.add(shape, 1, at.getOrigin(), at.getRotation());
    body.setFriction(0);
    body.setCcdMotionThreshold(btScalar(0.1));
    start(w, body, draw);
    body.setRestitution(restitution);
    const double speed = body.getLinearVelocity().x(), energy = energyOf(body);
    w.step(steps);
    kept.speed += body.getLinearVelocity().x() / speed / kCount;
    kept.energy += energyOf(body) / energy / kCount;
    kept.mostEnergy = std::max(kept.mostEnergy, energyOf(body) / energy);
  }
  return kept;
}

// Turned at random, the lowest corner so far below the floor, at 8 m/s sideways and 6 down, weightless.
Kept setDown(const std::shared_ptr<btCollisionShape>& ground, double dip, btScalar restitution) {
  const auto place = [&](const auto& draw) {
    const btScalar a = draw(), b = draw(), c = draw(), d = draw();
    const btQuaternion turn = btQuaternion(a, b, c, d).normalized();
    btScalar lowest = 0;
    for (const Vec3d& v : box().vertices)
      lowest = std::min(lowest, quatRotate(turn, btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z))).z());
    return btTransform(turn, btVector3(0, 0, -lowest - btScalar(dip)));
  };
  const auto start = [](BulletWorld<>&, btRigidBody& body, const auto&) {
    body.setGravity(btVector3(0, 0, 0));
    body.setLinearVelocity(btVector3(8, 0, -6));
  };
  return follow(ground, restitution, 12, place, start);
}

// At rest on the floor, then struck sideways, down and into a spin.
Kept kick(const std::shared_ptr<btCollisionShape>& ground) {
  const auto place = [](const auto& draw) {
    return btTransform(btQuaternion(btVector3(0, 0, 1), 3 * draw()), btVector3(-8, 0, btScalar(0.25)));
  };
  const auto start = [](BulletWorld<>& w, btRigidBody& body, const auto& draw) {
    w.step(60);
    body.activate(true);
    const btScalar a = draw(), b = draw(), c = draw();
    body.setLinearVelocity(btVector3(20, 0, -2));
    body.setAngularVelocity(btVector3(a, b, c) * 15);
  };
  return follow(ground, 0, 60, place, start);
}

// 0.31 and 2.2 times the energy before floors were known that a body lies in.
TEST(SetDown, InAFloorSlidesOnAndGainsNothing) {
  const std::shared_ptr<btCollisionShape> mesh = bvhMesh(plate());
  for (const double dip : {0.01, 0.05, 0.15})
    for (const btScalar restitution : {btScalar(0), btScalar(1)}) {
      const Kept kept = setDown(mesh, dip, restitution);
      std::cout << "boxes " << dip << " m in a mesh, restitution " << restitution << ": keep " << kept.speed
                << " of their speed, " << kept.energy << " of their energy, at most " << kept.mostEnergy << "\n";
      EXPECT_GT(kept.speed, 0.95) << "seed " << kSeed;
      EXPECT_LT(kept.mostEnergy, 1.1) << "seed " << kSeed;
    }
}

TEST(SetDown, KickedSlidesOn) {
  const Kept onMesh = kick(bvhMesh(plate())), onTree = kick(builtShape(plate()));
  std::cout << "kicked boxes keep " << onMesh.speed << " of their speed on a mesh, " << onTree.speed << " on a tree\n";
  // The part that a single box keeps on a mesh is chance, 0.2 to 1: the mean of 150 is 0.87, of 60 it may be 0.04 off.
  EXPECT_GT(onMesh.speed, 0.8) << "seed " << kSeed;
  EXPECT_GT(onTree.speed, 0.85) << "seed " << kSeed;
}

}  // namespace
}  // namespace cairn::test::set_down_test
