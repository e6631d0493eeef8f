// SPDX-License-Identifier: Zlib
// On a hundredth of the operations they need, flat bodies lie on the ground: spheres around them let them turn into it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <tuple>

#include "bullet_world.h"
#include "collider_shapes.h"
#include "random_tree.h"

namespace cairn::test::coarse_points_test {
namespace {

double lowestVertex(const btRigidBody& body) {
  const bullet::SphereTreeShape& shape = *bullet::asSphereTree(body.getCollisionShape());
  const btTransform place = body.getWorldTransform() * shape.bodyFromTree();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& v : shape.tree().vertices())
    lowest = std::min(lowest, double((place * (btVector3(v.x, v.y, v.z) * shape.scale())).z()));
  return lowest;
}

// Some roll off it: grounds reach eight metres to every side.
bool isOverGround(const btRigidBody& body) {
  const btVector3& at = body.getWorldTransform().getOrigin();
  return std::max(std::abs(at.x()), std::abs(at.y())) < 7;
}

// By the name of what they fall on.
class SlabsOnFewOperations : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(On, SlabsOnFewOperations, testing::Values("plane", "box", "field"));

TEST_P(SlabsOnFewOperations, DoNotTurnIntoTheGround) {
  constexpr int kSlabs = 3, kSteps = 900;
  // While it waits a body may sink by 3 % of its size where something touches.
  constexpr double kHeld = 0.03;
  const auto slab = plainTree(cuboid({0.69, 0.69, 0.2}, 4));
  const auto grounds = everyGround([](const Solid& solid) { return plainTree(solid); });
  const auto ground = std::ranges::find(grounds, GetParam(), &TriedGround::name);
  ASSERT_NE(ground, grounds.end());
  double deepest = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    BulletWorld<> w;
    ASSERT_TRUE(w.dispatcher.setBudget({100, {}}).ok());
    w.add(ground->shape, 0, btVector3(0, 0, -ground->top), ground->turned);
    std::vector<btRigidBody*> slabs;
    for (int i = 0; i < kSlabs; ++i) {
      const btQuaternion turned(btVector3(1, btScalar(0.3 * seed), btScalar(i)), btScalar(0.7 * seed + i));
      slabs.push_back(&w.add(treeShape(slab), 1, btVector3(btScalar(0.2 * i), 0, btScalar(0.7 + 0.8 * i)), turned));
      slabs.back()->setActivationState(DISABLE_DEACTIVATION);
    }
    for (int i = 0; i < kSteps; ++i) {
      w.step();
      if (i <= kSteps / 3) continue;
      for (const btRigidBody* body : slabs)
        if (isOverGround(*body)) deepest = std::max(deepest, -lowestVertex(*body));
    }
  }
  RecordProperty("deepest_m", std::to_string(deepest));
  EXPECT_LT(deepest, (kHeld + 0.01) * double(treeShape(slab)->size())) << "of four falls, once they lie";
}

// By the name of what it falls on, and on how many operations.
class BallsOnThinFloors : public testing::TestWithParam<std::tuple<const char*, std::int64_t>> {};
INSTANTIATE_TEST_SUITE_P(On, BallsOnThinFloors,
                         testing::Combine(testing::Values("box", "field"), testing::Values(0, 10)));

// Half its thickness deep, a point is nearer to the floor's other side: it must not be pushed on, or spun.
TEST_P(BallsOnThinFloors, GainNoEnergy) {
  constexpr int kFalls = 60, kSteps = 240;
  constexpr double kHalf = 0.05, kGained = 1.5;  // J/kg; 0.6 at most, 9 with points that push on
  const auto [kind, operations] = GetParam();
  const auto round = plainTree(ball(0.35, 6));
  std::shared_ptr<btCollisionShape> floor = std::make_shared<btBoxShape>(btVector3(4, 4, btScalar(kHalf)));
  if (std::string(kind) == "field")
    floor = fieldShape({{-4, -4, -1}, {4, 4, 1}, {32, 32, 80}}, boxDistance({3.5, 3.5, kHalf}));
  double gained = 0;
  for (int seed = 1; seed <= kFalls; ++seed) {
    std::mt19937_64 engine(std::uint64_t(seed) * 77);
    const auto any = [&] { return btScalar(uniform(engine, -1, 1)); };
    BulletWorld<> w;
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    w.add(floor, 0, btVector3(0, 0, btScalar(-kHalf)));
    const btQuaternion turned(btVector3(any(), any(), any() + btScalar(1.01)), 3 * any());
    btRigidBody& body = w.add(treeShape(round), 1, btVector3(0, 0, btScalar(1.3) + btScalar(0.3) * any()), turned);
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setAngularVelocity(btVector3(any(), any(), any()) * 3);
    double least = energyPerMass(body);
    for (int i = 0; i < kSteps; ++i) {
      w.step();
      const btVector3& at = body.getWorldTransform().getOrigin();
      if (std::max(std::abs(at.x()), std::abs(at.y())) > btScalar(2.5)) break;
      const double energy = energyPerMass(body);
      gained = std::max(gained, energy - least);
      least = std::min(least, energy);
    }
  }
  RecordProperty("gained_j_per_kg", std::to_string(gained));
  EXPECT_LT(gained, kGained) << "of " << kFalls << " falls, seeds from 1";
}

}  // namespace
}  // namespace cairn::test::coarse_points_test
