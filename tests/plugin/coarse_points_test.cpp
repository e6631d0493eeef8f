// SPDX-License-Identifier: Zlib
// On a hundredth of the operations they need, flat bodies lie on the ground: spheres around them let them turn into it.
#include <gtest/gtest.h>

#include <algorithm>

#include "bullet_world.h"
#include "counterpart_shapes.h"

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

}  // namespace
}  // namespace cairn::test::coarse_points_test
