// SPDX-License-Identifier: Zlib
// A body bounces off at the user's restitution times its speed before, however long the step is.
#include <gtest/gtest.h>

#include <cmath>

#include "bullet_world.h"

namespace cairn::test::restitution_test {
namespace {

enum class Ground { plane, box, mesh, tree };

std::shared_ptr<btCollisionShape> meshFloor() {
  static btTriangleMesh mesh;
  if (mesh.getNumTriangles() == 0) {
    const btVector3 a(-5, -5, 0), b(5, -5, 0), c(5, 5, 0), d(-5, 5, 0);
    mesh.addTriangle(a, b, c);
    mesh.addTriangle(a, c, d);
  }
  return std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
}

btRigidBody& addFloor(BulletWorld<>& w, Ground ground) {
  switch (ground) {
    case Ground::plane:
      return w.addGround();
    case Ground::box:
      return w.add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, -1));
    case Ground::mesh:
      return w.add(meshFloor(), 0, btVector3(0, 0, 0));
    case Ground::tree:
      break;
  }
  return w.add(treeShape(plainTree(cuboid({4, 4, 1}, 4))), 0, btVector3(0, 0, btScalar(-0.5)));
}

std::shared_ptr<const SphereTree> bouncer() {
  static const std::shared_ptr<const SphereTree> tree = plainTree(cuboid({1, 1, 1}, 4));
  return tree;
}

struct Bounce {
  btScalar before = 0, after = 0;
};

// A cube that falls flat without gravity: the speeds before and after it met the floor.
Bounce bounceOf(Ground ground, btScalar speed, btScalar restitution, btScalar timeStep, btScalar height) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  addFloor(w, ground).setRestitution(1);
  btRigidBody& body = w.add(treeShape(bouncer()), 1, btVector3(0, 0, btScalar(0.5) + height));
  body.setRestitution(restitution);
  body.setFriction(0);
  body.setLinearVelocity(btVector3(0, 0, -speed));
  const int steps = 4 + static_cast<int>(std::ceil(height / (speed * timeStep)));
  for (int i = 0; i < steps; ++i) w.world.stepSimulation(timeStep, 0);
  return {speed, body.getLinearVelocity().z()};
}

class Restitution : public testing::TestWithParam<Ground> {};

// The solver's own accuracy: ten iterations over sixteen points, in single precision.
constexpr btScalar kSpeedTolerance = btScalar(0.01);

// In a step, of a body of 1 m: what moves farther sinks in so far that leaves of its sides touch as well.
constexpr btScalar kFarthest = btScalar(0.1);

TEST_P(Restitution, DoesNotDependOnTheStep) {
  for (const btScalar restitution : {btScalar(0.3), btScalar(1)})
    for (const btScalar speed : {btScalar(0.5), btScalar(3), btScalar(14)})
      for (const btScalar steps : {btScalar(60), btScalar(240), btScalar(1000)}) {
        if (speed / steps > kFarthest) continue;
        // Wherever within a step the floor is met, and wherever within the speculative distance.
        for (int phase = 0; phase < 8; ++phase) {
          const btScalar height =
              btScalar(0.02) + btScalar(phase) / 8 * speed / steps + btScalar(0.0004) * btScalar(phase);
          const Bounce bounce = bounceOf(GetParam(), speed, restitution, 1 / steps, height);
          EXPECT_NEAR(bounce.after / bounce.before, restitution, kSpeedTolerance)
              << restitution << " at " << speed << " m/s, " << steps << " Hz, phase " << phase;
        }
      }
}

// Bullet's solver bounces nothing slower: it settles instead.
TEST_P(Restitution, WhatIsSlowComesToRest) {
  const Bounce bounce = bounceOf(GetParam(), btScalar(0.1), 1, btScalar(1.0 / 60), btScalar(0.01));
  EXPECT_NEAR(bounce.after, 0, 0.1 * kSpeedTolerance);
}

TEST_P(Restitution, NoneIsNone) {
  const Bounce bounce = bounceOf(GetParam(), 3, 0, btScalar(1.0 / 240), btScalar(0.03));
  EXPECT_LE(std::abs(bounce.after), btScalar(0.5));  // Bullet lifts what has sunk in at 0.2 of the depth a step
}

std::string nameOf(const testing::TestParamInfo<Ground>& info) {
  constexpr const char* kNames[] = {"Plane", "Box", "Mesh", "Tree"};
  return kNames[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(On, Restitution, testing::Values(Ground::plane, Ground::box, Ground::mesh, Ground::tree),
                         nameOf);

}  // namespace
}  // namespace cairn::test::restitution_test
