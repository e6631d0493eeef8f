// SPDX-License-Identifier: Zlib
// Once a scene has warmed up, a step allocates nothing on our side. Bullet allocates with its own functions, not with
// `new`.
#include <gtest/gtest.h>

#include "counting_new.h"
#include "front_ends.h"
#include "pile.h"
#include "priorities.h"

namespace cairn::test::allocation_test {
namespace {

class Allocation : public testing::TestWithParam<std::tuple<std::optional<std::int64_t>, const char*, FrontEnd>> {};

TEST_P(Allocation, IsNoneAfterWarmUp) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  inWorldOf(std::get<2>(GetParam()), [](auto& w) {
    ASSERT_TRUE(w.dispatcher.setBudget({std::get<0>(GetParam()), {}}).ok());
    w.dispatcher.setPriority(makePriority(std::get<1>(GetParam())));
    w.addGround();
    w.add(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.2))), 0, btVector3(0, 0, btScalar(0.2)));
    btTriangleMesh mesh;
    mesh.addTriangle(btVector3(-9, -9, btScalar(0.1)), btVector3(9, -9, btScalar(0.1)), btVector3(0, 9, btScalar(0.1)));
    w.add(std::make_shared<btBvhTriangleMeshShape>(&mesh, true), 0, btVector3(0, 0, 0));
    const auto tree = plainTree(ball(0.3, 5));
    for (int i = 0; i < 8; ++i) {
      btRigidBody& body =
          w.add(treeShape(tree), 1,
                btVector3(btScalar(0.35 * (i % 3) - 0.3), btScalar(0.3 * (i % 2)), btScalar(0.8 + 0.4 * i)));
      body.setActivationState(DISABLE_DEACTIVATION);
    }
    // A pair's lists are made when its spheres first touch, and grow with the most it ever had: balls that roll about
    // meet for minutes. What allocates in a step by itself does so in every thousand.
    w.step(1000);
    std::size_t made = 1;
    for (int thousand = 1; made > 0 && thousand < 15; ++thousand) {
      const std::size_t before = allocations();
      w.step(1000);
      made = allocations() - before;
    }
    EXPECT_GT(w.dispatcher.lastStep().contacts, 0U);
    EXPECT_EQ(made, 0U);
  });
}

// Pairs of bodies that sleep give memory back, which they take again when the bodies wake.
TEST(RestingPairs, KeepNoMoreThanTheyUse) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  const auto allocatedByWaking = [](int restingSteps) {
    Pile<bullet::Dispatcher<>> pile({});
    pile.w.step(300);
    const auto setStates = [&](int state) {
      for (btRigidBody* body : pile.bodies) body->forceActivationState(state);
    };
    setStates(ISLAND_SLEEPING);
    pile.w.step(restingSteps);
    const std::size_t before = allocations();
    setStates(DISABLE_DEACTIVATION);
    pile.w.step(5);
    EXPECT_GT(pile.w.dispatcher.lastStep().contacts, 20U);
    return allocations() - before;
  };
  EXPECT_EQ(allocatedByWaking(10), 0U);
  EXPECT_GT(allocatedByWaking(600), 50U);
}

INSTANTIATE_TEST_SUITE_P(Budgets, Allocation,
                         testing::Combine(testing::Values(std::optional<std::int64_t>(), 4000),
                                          testing::Values("RoundRobin"), testing::ValuesIn(kEveryFrontEnd)));
INSTANTIATE_TEST_SUITE_P(Priorities, Allocation,
                         testing::Combine(testing::Values(std::optional<std::int64_t>(4000)),
                                          testing::Values("TwoClasses", "WorstErrorFirst", "Perceptual"),
                                          testing::Values(FrontEnd::dispatcher)));

}  // namespace
}  // namespace cairn::test::allocation_test
