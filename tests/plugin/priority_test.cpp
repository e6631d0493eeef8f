// SPDX-License-Identifier: Zlib
// The data that a priority gets. With any priority bodies are held and bits repeat.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "bullet_world.h"
#include "priorities.h"

namespace cairn::test::priority_test {
namespace {

/// Round-robin that keeps what it was told.
class Witness final : public Priority {
 public:
  struct Heard {
    std::vector<ScheduledPair> pairs;
    std::optional<Viewer> viewer;
  };
  explicit Witness(Heard& heard) : heard_(&heard) {}
  void begin(std::span<const ScheduledPair> pairs) override {
    heard_->pairs.assign(pairs.begin(), pairs.end());
    inTurn_.begin(pairs);
  }
  std::optional<std::size_t> next() override { return inTurn_.next(); }
  void turnEnded(std::size_t pair, Progress progress) override { inTurn_.turnEnded(pair, progress); }
  void setViewer(const std::optional<Viewer>& viewer) override { heard_->viewer = viewer; }

 private:
  RoundRobin inTurn_;
  Heard* heard_;
};

TEST(PriorityFacts, AreThoseOfTheBodies) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto tree = plainTree(ball(0.5, 6));
  const auto small = treeShape(tree, btScalar(0.5));
  w.add(treeShape(tree), 3, btVector3(100, 0, 0));
  w.add(small, 2, btVector3(btScalar(100.74), 0, 0)).setLinearVelocity(btVector3(-4, 0, 0));
  Witness::Heard heard;
  w.dispatcher.setPriority(std::make_unique<Witness>(heard));
  ASSERT_TRUE(w.dispatcher.setBudget({1000000, {}}).ok());  // without a limit nobody waits for a turn
  w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(heard.pairs.size(), 1U);
  const ScheduledPair& pair = heard.pairs[0];
  EXPECT_NEAR(pair.size, static_cast<float>(small->size()), 1e-6F);
  EXPECT_LT(length(pair.center - Vec3d(100.74, 0, 0)), 0.01 * small->size()) << "a ball's middle is its root sphere's";
  EXPECT_NEAR(pair.closingSpeed, 4, 1e-5F);
  EXPECT_NEAR(pair.mass, 3 * 2 / 5.0, 1e-6);
  EXPECT_GT(pair.unansweredError, 0) << "a new pair has no answer";
}

TEST(PriorityFacts, WhatIsHeldFastHasTheOthersMass) {
  BulletWorld<> w;
  w.addGround();
  w.add(treeShape(plainTree(ball(0.3, 6))), 2, btVector3(0, 0, btScalar(0.295)));
  Witness::Heard heard;
  w.dispatcher.setPriority(std::make_unique<Witness>(heard));
  ASSERT_TRUE(w.dispatcher.setBudget({1000000, {}}).ok());  // without a limit nobody waits for a turn
  w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(heard.pairs.size(), 1U);
  EXPECT_NEAR(heard.pairs[0].mass, 2, 1e-6F);
  EXPECT_LT(length(heard.pairs[0].center - Vec3d(0, 0, 0.295)), 0.01) << "of the ball, not of the ground";
}

TEST(PriorityFacts, AnAnswerCounts_UntilTheBodiesHaveApproached) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto tree = plainTree(ball(0.5, 6));
  w.add(treeShape(tree), 1, btVector3(0, 0, 0));
  w.add(treeShape(tree), 1, btVector3(btScalar(0.99), 0, 0));
  Witness::Heard heard;
  w.dispatcher.setPriority(std::make_unique<Witness>(heard));
  ASSERT_TRUE(w.dispatcher.setBudget({1000000, {}}).ok());  // without a limit nobody waits for a turn
  w.world.performDiscreteCollisionDetection();
  EXPECT_GT(heard.pairs.at(0).unansweredError, 0);
  w.world.performDiscreteCollisionDetection();
  EXPECT_EQ(heard.pairs.at(0).unansweredError, 0) << "answered in the step before";
}

/// Round-robin that cares for one half of the world, and counts whose traversals are begun.
class LeftFirst final : public Priority {
 public:
  struct Begun {
    int left = 0, right = 0;
  };
  LeftFirst(Begun& begun, double right) : begun_(&begun), right_(right) {}
  void begin(std::span<const ScheduledPair> pairs) override {
    for (const ScheduledPair& pair : pairs)
      (pair.center.x < 0 ? begun_->left : begun_->right) += !pair.traversal->done();
    inTurn_.begin(pairs);
  }
  std::optional<std::size_t> next() override { return inTurn_.next(); }
  void turnEnded(std::size_t pair, Progress progress) override { inTurn_.turnEnded(pair, progress); }
  double importance(const ScheduledPair& pair) const override { return pair.center.x < 0 ? 1 : right_; }

 private:
  RoundRobin inTurn_;
  Begun* begun_;
  double right_;
};

// Eight pairs of balls to the left, eight to the right; all roll on each other, and there is enough for three.
LeftFirst::Begun begunWhenScarce(double importanceOfRight) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto tree = plainTree(ball(0.5, 6));
  std::vector<btRigidBody*> rolling;
  for (int i = 0; i < 16; ++i) {
    const btVector3 place(btScalar(i < 8 ? -9 : 9), btScalar(3 * (i % 8)), 0);
    w.add(treeShape(tree), 1, place);
    rolling.push_back(&w.add(treeShape(tree), 1, place + btVector3(btScalar(0.97), 0, 0)));
  }
  LeftFirst::Begun begun;
  w.dispatcher.setPriority(std::make_unique<LeftFirst>(begun, importanceOfRight));
  w.world.performDiscreteCollisionDetection();
  const auto forAll = static_cast<std::int64_t>(w.dispatcher.lastStep().operations);
  EXPECT_TRUE(w.dispatcher.setBudget({forAll * 3 / 16, {}}).ok());
  begun = {};
  for (int step = 1; step <= 60; ++step) {
    for (btRigidBody* body : rolling)
      body->getWorldTransform().setRotation(btQuaternion(btVector3(0, 0, 1), btScalar(0.1 * step)));
    w.world.performDiscreteCollisionDetection();
  }
  return begun;
}

TEST(PriorityWhenScarce, TellsWhichPairsAreBegun) {
  const LeftFirst::Begun alike = begunWhenScarce(1);
  EXPECT_GT(alike.left, 0.7 * alike.right);
  EXPECT_GT(alike.right, 0.7 * alike.left);
  const LeftFirst::Begun left = begunWhenScarce(1.0 / 16);
  EXPECT_GT(left.left, 4 * left.right);
  EXPECT_GT(left.right, 0) << "nobody waits for ever";
}

Viewer onlooker() {
  return {.eye = {0, -3, 1}, .direction = {0, 1, 0}, .focus = {0, 0, 0.3}, .fieldOfView = 1};
}

TEST(PriorityViewer, IsHandedOnAndHoldsForLaterPriorities) {
  BulletWorld<> w;
  Witness::Heard first, second;
  w.dispatcher.setPriority(std::make_unique<Witness>(first));
  EXPECT_FALSE(first.viewer);
  ASSERT_TRUE(w.dispatcher.setViewer(onlooker()).ok());
  EXPECT_TRUE(first.viewer);
  w.dispatcher.setPriority(std::make_unique<Witness>(second));
  ASSERT_TRUE(second.viewer);
  EXPECT_EQ(second.viewer->eye, onlooker().eye);
  ASSERT_TRUE(w.dispatcher.setViewer({}).ok());
  EXPECT_FALSE(second.viewer);
}

TEST(PriorityViewer, NonsenseIsRefusedAndChangesNothing) {
  BulletWorld<> w;
  Witness::Heard heard;
  w.dispatcher.setPriority(std::make_unique<Witness>(heard));
  Viewer blind = onlooker();
  blind.fieldOfView = 0;
  const Status status = w.dispatcher.setViewer(blind);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("field of view"), std::string::npos);
  EXPECT_FALSE(heard.viewer);
}

TEST(PriorityViewer, SeesTheStepsErrorAsAnAngle) {
  BulletWorld<> w;
  w.addGround();
  const auto shape = treeShape(plainTree(ball(0.3, 6)));
  w.add(shape, 1, btVector3(0, 0, btScalar(0.295)));
  w.world.performDiscreteCollisionDetection();
  EXPECT_EQ(w.dispatcher.lastStep().worstSeenError, 0) << "nobody looks";
  ASSERT_TRUE(w.dispatcher.setViewer(onlooker()).ok());
  w.world.performDiscreteCollisionDetection();
  const auto& s = w.dispatcher.lastStep();
  const double distance = length(Vec3d(0, 0, 0.295) - onlooker().eye);
  EXPECT_NEAR(s.worstSeenError, s.worstErrorFraction * shape->size() / distance, 0.01 * s.worstSeenError);
  EXPECT_GT(s.meanSeenError, 0);
  Viewer turnedAway = onlooker();
  turnedAway.direction = Vec3d(0, -1, 0);
  ASSERT_TRUE(w.dispatcher.setViewer(turnedAway).ok());
  w.world.performDiscreteCollisionDetection();
  EXPECT_EQ(w.dispatcher.lastStep().worstSeenError, 0);
}

class PriorityPolicies : public testing::TestWithParam<std::string> {};

struct Fall {
  std::uint64_t hash = 0;
  btScalar lowest = 0, fastest = 0;
};

// Metres: a ring that lies flat has its middle at the height of its tube's radius. Guards on this budget
// let rings sink by 0.008 at most; twice that is allowed.
constexpr double kTube = 0.1, kSunk = 0.016;

Fall drop(const std::string& priority, bool isWatched) {
  BulletWorld<> w;
  w.addGround();
  const auto tree = plainTree(torus(0.3, kTube, 16));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 12; ++i)
    bodies.push_back(&w.add(treeShape(tree), 1,
                            btVector3(btScalar(0.3 * (i % 2)), btScalar(0.2 * (i % 3)), btScalar(0.5 + 0.3 * i)),
                            btQuaternion(btVector3(1, 0, 0), btScalar(0.4 * i))));
  w.dispatcher.setPriority(makePriority(priority));
  EXPECT_TRUE(w.dispatcher.setBudget({1500, {}}).ok());
  if (isWatched) EXPECT_TRUE(w.dispatcher.setViewer(onlooker()).ok());
  w.step(240);
  Fall fall{w.stateHash(), 1, 0};
  for (const btRigidBody* body : bodies) {
    EXPECT_TRUE(isSane(*body));
    fall.lowest = std::min(fall.lowest, body->getWorldTransform().getOrigin().z());
    fall.fastest = std::max(fall.fastest, body->getLinearVelocity().length());
  }
  return fall;
}

TEST_P(PriorityPolicies, HoldAHeapOnASmallBudget_WithTheSameBitsTwice) {
  for (const bool isWatched : {false, true}) {
    const Fall fall = drop(GetParam(), isWatched);
    EXPECT_GE(double(fall.lowest), kTube - kSunk) << "a ring sank into the ground";
    EXPECT_LT(fall.fastest, 3) << "thrown about";
    EXPECT_EQ(fall.hash, drop(GetParam(), isWatched).hash);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PriorityPolicies, testing::ValuesIn(kPriorities),
                         [](const auto& policy) { return policy.param; });

}  // namespace
}  // namespace cairn::test::priority_test
