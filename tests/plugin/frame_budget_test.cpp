// SPDX-License-Identifier: Zlib
// One budget for all steps of a frame.
#include <gtest/gtest.h>

#include <random>

#include "cairn/bullet/frame_budget.h"
#include "cairn/bullet/step_frame.h"
#include "front_ends.h"

namespace cairn::test::frame_budget_test {
namespace {

using bullet::FrameBudget;

TEST(FrameBudget_Share, IsAnEqualPartOfWhatIsLeft) {
  FrameBudget frame({1000, 400.0});
  frame.begin(4);
  EXPECT_EQ(frame.share().operations, 250);
  EXPECT_EQ(frame.share().microseconds, 100.0);
  frame.spend(100, 40);  // quiet
  EXPECT_EQ(frame.share().operations, 300);
  EXPECT_EQ(frame.share().microseconds, 120.0);
  frame.spend(700, 400);  // beyond its part
  EXPECT_EQ(frame.share().operations, 100);
  EXPECT_EQ(frame.share().microseconds, 0.0);
  frame.spend(5000, 1);
  EXPECT_EQ(frame.share().operations, 0);
  frame.begin(1);
  EXPECT_EQ(frame.share().operations, 1000) << "nothing is owed to the next frame, and nothing saved";
}

TEST(FrameBudget_Share, OfAStepNobodyAnnouncedIsTheWhole) {
  FrameBudget frame({1000, {}});
  EXPECT_EQ(frame.share().operations, 1000);
  EXPECT_FALSE(frame.share().microseconds);
  frame.begin(1);
  frame.spend(900, 0);
  EXPECT_EQ(frame.share().operations, 1000);
  frame.begin(-3);
  EXPECT_EQ(frame.share().operations, 1000);
}

// Whatever the steps use: those that keep to their shares keep the frame's budget.
TEST(FrameBudget_Share, NeverAddsUpToMoreThanTheFrame) {
  std::mt19937_64 engine(11);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto whole = static_cast<std::int64_t>(engine() % 100000);
    FrameBudget frame({whole, {}});
    const int steps = 1 + static_cast<int>(engine() % 8);
    frame.begin(steps);
    std::int64_t used = 0;
    for (int i = 0; i < steps; ++i) {
      const std::int64_t share = frame.share().operations.value();
      const std::int64_t step = static_cast<std::int64_t>(engine() % 3) * share / 2;
      used += std::min(step, share);
      frame.spend(static_cast<std::uint64_t>(std::min(step, share)), 0);
    }
    EXPECT_LE(used, whole) << "seed 11, trial " << trial;
  }
}

TEST(FrameBudget_Tighter, TakesTheSmallerOfEach) {
  const auto both = bullet::tighter({100, {}}, {200, 5.0});
  EXPECT_EQ(both.operations, 100);
  EXPECT_EQ(both.microseconds, 5.0);
  EXPECT_FALSE(bullet::tighter({}, {}).operations);
}

int gTicks = 0;

TEST(StepFrame_StepsOf, IsWhatBulletMakes) {
  std::mt19937_64 engine(12);
  BulletWorld<> w;
  w.world.setInternalTickCallback([](btDynamicsWorld*, btScalar) { ++gTicks; });
  int seen[5] = {};
  for (int trial = 0; trial < 3000; ++trial) {
    const auto frame = btScalar(engine() % 1000) / btScalar(20000);
    const auto fixed = trial % 7 ? btScalar(1) / btScalar(120) : frame / 3 + btScalar(0.001);
    const int maxSubSteps = static_cast<int>(engine() % 5);
    const int expected = bullet::stepsOf(w.world, frame, maxSubSteps, fixed);
    gTicks = 0;
    w.world.stepSimulation(frame, maxSubSteps, fixed);
    ASSERT_EQ(expected, gTicks) << "seed 12, trial " << trial;
    ++seen[expected];
  }
  for (const int count : seen) EXPECT_GT(count, 0);
}

CAIRN_FRONT_END_SUITE(StepFrame_Budget, EveryFrontEnd);

template <class FrontEnd>
struct Watch {
  const FrontEnd* dispatcher;
  std::vector<std::uint64_t> operations;
  static void tick(btDynamicsWorld* world, btScalar) {
    auto& self = *static_cast<Watch*>(world->getWorldUserInfo());
    self.operations.push_back(self.dispatcher->lastStep().operations);
  }
};

// Two plates with a gap: the traversal goes far down and finds no leaves that touch, so that what a step is charged is
// refinement and, while it is unfinished, the head of the front and the whole bodies.
template <class FrontEnd>
struct Plates {
  BulletWorld<FrontEnd> w;
  Watch<FrontEnd> watch{&w.dispatcher, {}};

  Plates() {
    w.world.setGravity(btVector3(0, 0, 0));
    w.world.setInternalTickCallback(&Watch<FrontEnd>::tick, &watch);
    static const auto plate = plainTree(cuboid({1, 1, 0.2}, 24));
    for (const double z : {0.0, 0.28})
      w.add(treeShape(plate), 1, btVector3(0, 0, btScalar(z))).setActivationState(DISABLE_DEACTIVATION);
  }
  std::uint64_t frame(int steps) {
    watch.operations.clear();
    const btScalar fixed = btScalar(1) / 60 / btScalar(steps);
    bullet::stepFrame(w.world, w.dispatcher, btScalar(1) / 60 * btScalar(1.0001), 8, fixed);
    EXPECT_EQ(watch.operations.size(), static_cast<std::size_t>(steps));
    std::uint64_t sum = 0;
    for (const std::uint64_t operations : watch.operations) sum += operations;
    return sum;
  }
};

TYPED_TEST(StepFrame_Budget, IsSharedByOneTwoAndFourSteps) {
  constexpr std::uint64_t kFrame = 10000, kUnfinished = (128 + 65) * 3;
  for (const int steps : {1, 2, 4}) {
    SCOPED_TRACE(steps);
    Plates<TypeParam> unlimited, limited;
    ASSERT_GT(unlimited.frame(1), 2 * kFrame) << "the limit never bites: the test shows nothing";
    ASSERT_TRUE(limited.w.dispatcher.setFrameBudget({kFrame, {}}).ok());
    const std::uint64_t used = limited.frame(steps);
    EXPECT_LE(used, kFrame + kUnfinished) << "only the last step has nobody after it to make up for it";
    const auto share = kFrame / static_cast<std::uint64_t>(steps);
    EXPECT_LE(limited.watch.operations.front(), share + kUnfinished);
    EXPECT_GT(limited.watch.operations.back(), share / 9) << "nobody is left without";
  }
}

TYPED_TEST(StepFrame_Budget, LeavesWhatAQuietStepDoesNotUse) {
  Plates<TypeParam> plates;
  const std::uint64_t whole = plates.frame(1);
  btCollisionObject& upper = *plates.w.world.getCollisionObjectArray()[1];
  ASSERT_TRUE(plates.w.dispatcher.setFrameBudget({static_cast<std::int64_t>(whole + whole / 4), {}}).ok());
  plates.w.dispatcher.beginFrame(2);
  for (const double aside : {0.99, 0.0}) {
    upper.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(aside), 0, btScalar(0.28))));
    plates.w.step();
    EXPECT_EQ(plates.w.dispatcher.lastStep().pairs, 1U);
    EXPECT_EQ(plates.w.dispatcher.lastStep().unresolvedPairs, 0U) << "the second takes more than half of the frame's";
  }
  EXPECT_GT(plates.w.dispatcher.lastStep().operations, whole / 8 * 5);
}

TYPED_TEST(StepFrame_Budget, HoldsBesideThatOfASingleStep) {
  Plates<TypeParam> plates;
  ASSERT_TRUE(plates.w.dispatcher.setFrameBudget({10000, {}}).ok());
  ASSERT_TRUE(plates.w.dispatcher.setBudget({500, {}}).ok());
  EXPECT_LE(plates.frame(4), 4 * (500U + (128 + 65) * 3));
  ASSERT_TRUE(plates.w.dispatcher.setBudget({}).ok());
  EXPECT_GT(plates.frame(4), 8000U);
  EXPECT_FALSE(plates.w.dispatcher.setFrameBudget({-1, {}}).ok());
}

}  // namespace
}  // namespace cairn::test::frame_budget_test
