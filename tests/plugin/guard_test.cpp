// SPDX-License-Identifier: Zlib
// Guards: what stands in for contacts when a pair gets no budget. They hold, and they neither shift nor kick.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "bullet_world.h"
#include "random_tree.h"
#include "triangle_grounds.h"

namespace cairn::test::guard_test {
namespace {

constexpr btScalar kStep = btScalar(1) / 60;

// A floor at height 0 and a wall at x = 2, one mesh.
std::shared_ptr<btCollisionShape> floorAndWall() {
  std::vector<btVector3> corners;
  const auto quad = [&](const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& d) {
    corners.insert(corners.end(), {a, b, c, a, c, d});
  };
  for (int i = -10; i < 10; ++i)
    for (int j = -10; j < 10; ++j) {
      const auto x = btScalar(i), y = btScalar(j), z = btScalar(i + 4);
      quad({x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0});
      if (i >= -4 && i < 6) quad({2, y, z}, {2, y, z + 1}, {2, y + 1, z + 1}, {2, y + 1, z});
    }
  return meshOf(corners);
}

struct RodToWall {
  BulletWorld<> w;
  btRigidBody* rod = nullptr;

  // A rod of 3 m stands on the floor and slides at 2 m/s towards the wall.
  explicit RodToWall(std::int64_t operations) {
    EXPECT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    w.add(floorAndWall(), 0, btVector3(0, 0, 0));
    rod = &w.add(treeShape(plainTree(cuboid({3, 0.3, 0.3}, 3))), 1, btVector3(btScalar(0.5), 0, btScalar(1.51)),
                 btQuaternion(btVector3(0, 1, 0), SIMD_HALF_PI));
    rod->setLinearVelocity(btVector3(2, 0, 0));
    rod->setFriction(0);
    rod->setActivationState(DISABLE_DEACTIVATION);
  }
};

class GuardedRod : public testing::TestWithParam<std::int64_t> {};

// The whole rod's sphere overlaps the floor by half its length, and may. Were that taken for something sunk into the
// wall, split impulses would shift the rod by a fifth of it in one step: 0.3 m. What really sinks under a small budget
// is little more than the rod's thickness; half of that shift tells the two apart.
TEST_P(GuardedRod, IsNotShiftedByAWall) {
  RodToWall scene(GetParam());
  for (int i = 0; i < 300; ++i) {
    const btVector3 before = scene.rod->getWorldTransform().getOrigin();
    scene.w.step();
    const btScalar moved = scene.rod->getWorldTransform().getOrigin().distance(before);
    ASSERT_LT(moved - scene.rod->getLinearVelocity().length() * kStep, 0.15) << "step " << i;
    ASSERT_GT(scene.rod->getWorldTransform().getOrigin().z(), 0) << "step " << i;
    ASSERT_LT(scene.rod->getWorldTransform().getOrigin().x(), 2) << "step " << i;
  }
}

// Without split impulses the same shift would be a kick of 0.3 m in a step, 18 m/s. Falling, its centre reaches 5.5 m/s
// (2 m/s and 1.36 m of height); what has sunk by its thickness is pushed out with 0.2 * 0.3 m in a step more.
TEST_P(GuardedRod, IsNotKickedByAWall) {
  RodToWall scene(GetParam());
  scene.w.world.getSolverInfo().m_splitImpulse = 0;
  const double fallen = std::sqrt(4 + 2 * 9.81 * 1.36), pushedOut = 0.2 * 0.3 / kStep;
  for (int i = 0; i < 300; ++i) {
    scene.w.step();
    ASSERT_LT(scene.rod->getLinearVelocity().length(), fallen + pushedOut) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Tiny, GuardedRod, testing::Values(1, 45));
INSTANTIATE_TEST_SUITE_P(Budgets, GuardedRod, testing::Range<std::int64_t>(0, 1500, 50));

// The centres of a wide ground and a small body on it say nothing about which way is up.
TEST(Guards_OnAWideTree, HoldASmallBodyAnywhereWithBoundedWork) {
  const Vec3d size{0.6, 0.5, 0.4};
  const auto body = plainTree(cuboid(size, 4));
  for (const double width : {4.0, 12.0})
    for (const btScalar aside : {btScalar(0), btScalar(1.5)})
      for (const bool groundFirst : {false, true})
        for (const std::int64_t operations : {0, 1, 45, 100}) {
          BulletWorld<> w;
          ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
          const auto ground = treeShape(plainTree(cuboid({width, width, 1}, width > 4 ? 16 : 8)));
          if (groundFirst) w.add(ground, 0, btVector3(0, 0, btScalar(-0.5)));
          btRigidBody& cube = w.add(treeShape(body), 1, btVector3(aside, btScalar(0.1), btScalar(0.3)));
          if (!groundFirst) w.add(ground, 0, btVector3(0, 0, btScalar(-0.5)));
          cube.setActivationState(DISABLE_DEACTIVATION);
          for (int i = 0; i < 400; ++i) {
            w.step();
            // Without refinement: re-tests and the front as ever, and eight families for the whole bodies.
            if (operations <= 1)
              ASSERT_LE(w.dispatcher.lastStep().operations, 32 * 5 + 128 * 3 + 65 * 3) << "step " << i;
          }
          EXPECT_GT(cube.getWorldTransform().getOrigin().z(), 0.1)
              << width << " m wide, " << aside << " m aside, budget " << operations;
        }
}

// A ball whose nodes say how much of them is inside: the root's centre is, as deep as the faces are near.
std::shared_ptr<const SphereTree> solidBall(double radius, bool knowsItsInside) {
  SphereTreeData data = PlainTreeBuilder(ball(radius, 6), 2).build();
  float inner = data.nodes[0].radius;
  for (const auto& t : data.triangles) {
    const Vec3 a = data.vertices[t[0]], b = data.vertices[t[1]], c = data.vertices[t[2]];
    inner = std::min(inner, std::abs(dot(normalized(cross(b - a, c - a)), a - data.nodes[0].center)));
  }
  if (knowsItsInside) data.nodes[0].innerRadius = inner;
  return std::make_shared<const SphereTree>(SphereTree::create(std::move(data)).value());
}

// Without any budget: how far apart two balls are that start half in each other, after two seconds.
btScalar apartWithoutBudget(bool knowsItsInside) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  EXPECT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  const auto tree = solidBall(0.5, knowsItsInside);
  const btRigidBody& first = w.add(treeShape(tree), 1, btVector3(0, 0, 0));
  const btRigidBody& second = w.add(treeShape(tree), 1, btVector3(btScalar(0.5), 0, 0));
  w.step(120);
  EXPECT_TRUE(isSane(first) && isSane(second));
  EXPECT_LT(second.getLinearVelocity().length(), 5);
  return (second.getWorldTransform().getOrigin() - first.getWorldTransform().getOrigin()).length();
}

// Bodies that certainly overlap come apart without any refinement; those that only may overlap are held.
TEST(Guards_OfBallsInsideBothBodies, PushThemApart) {
  const float inner = solidBall(0.5, true)->innerRadius(kRootNode);
  ASSERT_GT(inner, 0.4F);
  // Bullet leaves a fifth of the depth per step, and half a millimetre of slop.
  EXPECT_GT(apartWithoutBudget(true), 2 * btScalar(inner) - btScalar(0.01));
  EXPECT_NEAR(apartWithoutBudget(false), 0.5, 0.01);
}

// So do the points that its children reach lowest with, whether the balls inside are known or not.
TEST(Guards_OfBallsInsideBothBodies, LiftThemOutOfAPlane) {
  for (const bool knows : {true, false}) {
    BulletWorld<> w;
    w.addGround();
    EXPECT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
    const btRigidBody& body = w.add(treeShape(solidBall(0.5, knows)), 1, btVector3(0, 0, btScalar(0.1)));
    w.step(240);
    EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.4) << knows;
  }
}

// Four layers of cuboids set down in a pit that the spheres around them are too large for: they wedge. Guards that
// follow whatever the solver's noise parts would push them ever wider and upwards, by 14 J/kg.
TEST(Guards_OfWholeBodies, DoNotClimb) {
  constexpr int kBodies = 16, kSteps = 600;
  constexpr double kGained = 1;  // J/kg; 0.3 without a budget
  const auto slab = treeShape(plainTree(cuboid({0.8, 0.8, 0.4}, 4)));
  for (const std::int64_t operations : {0, 20, 100, 300}) {
    for (int seed = 1; seed <= 3; ++seed) {
      std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
      const auto any = [&](double most) { return btScalar(uniform(engine, -most, most)); };
      BulletWorld<> w;
      ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
      w.addGround();
      for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
        w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-0.9)), 0, btVector3(0, 0, 0));
      std::vector<btRigidBody*> bodies;
      for (int i = 0; i < kBodies; ++i) {
        const btVector3 at(btScalar(i % 2) - btScalar(0.5) + any(0.02), btScalar(i / 2 % 2) - btScalar(0.5) + any(0.02),
                           btScalar(0.4) + btScalar(0.41) * btScalar(i / 4));
        bodies.push_back(&w.add(slab, 1, at, btQuaternion(btVector3(0, 0, 1), any(0.05))));
        bodies.back()->setActivationState(DISABLE_DEACTIVATION);
      }
      double least = std::numeric_limits<double>::infinity(), gained = 0;
      for (int i = 0; i < kSteps; ++i) {
        w.step();
        double energy = 0;
        for (const btRigidBody* body : bodies) energy += energyPerMass(*body) / kBodies;
        least = std::min(least, energy);
        gained = std::max(gained, energy - least);
      }
      EXPECT_LT(gained, kGained) << operations << " operations, seed " << seed;
    }
  }
}

}  // namespace
}  // namespace cairn::test::guard_test
