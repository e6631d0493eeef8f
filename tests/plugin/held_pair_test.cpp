// SPDX-License-Identifier: Zlib
// Pairs for which a step has nothing left: what they said last follows their bodies.
#include <gtest/gtest.h>

#include <functional>

#include "front_ends.h"

namespace cairn::test::held_pair_test {
namespace {

using bullet::kSpeculativeFraction;

// A world in which nothing moves but by hand. Far away eight balls are in each other and never where they were: with a
// budget of one operation their pairs are more urgent for some twenty steps, and what else is there is held.
template <class DispatcherType>
class BusyWorld {
 public:
  static constexpr int kBalls = 8;
  static constexpr std::uint32_t kBusyPairs = kBalls * (kBalls - 1) / 2;

  BulletWorld<DispatcherType> w;

  BusyWorld() {
    w.world.setGravity(btVector3(0, 0, 0));
    const auto round = treeShape(plainTree(ball(0.5, 8)));
    for (int i = 0; i < kBalls; ++i) balls_.push_back(&w.add(round, 1, btVector3(20 + 2 * btScalar(i), 0, 0)));
  }

  void detect() {
    ++step_;
    for (int i = 0; i < kBalls; ++i)
      place(*balls_[static_cast<std::size_t>(i)], btVector3(20, btScalar(0.1) * btScalar((i * step_) % kBalls), 0));
    w.world.performDiscreteCollisionDetection();
  }
  void place(btRigidBody& body, const btVector3& at, const btQuaternion& turned = btQuaternion::getIdentity()) {
    body.setWorldTransform(btTransform(turned, at));
  }
  // Of the body; returns how many.
  int points(const btRigidBody& body, const std::function<void(const btManifoldPoint&)>& visit) {
    int count = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      if (m.getBody0() != &body && m.getBody1() != &body) continue;
      for (int k = 0; k < m.getNumContacts(); ++k, ++count) visit(m.getContactPoint(k));
    }
    return count;
  }

 private:
  std::vector<btRigidBody*> balls_;
  int step_ = 0;
};

// In it a cube of a metre on another one, half a millimetre in it.
template <class DispatcherType>
struct HeldCubes : private BusyWorld<DispatcherType> {
  using Base = BusyWorld<DispatcherType>;
  using Base::place;
  using Base::w;
  static constexpr btScalar kHeight = btScalar(0.9995);

  std::shared_ptr<bullet::SphereTreeShape> cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  btRigidBody *lower = nullptr, *upper = nullptr;

  explicit HeldCubes(std::shared_ptr<btCollisionShape> upperShape = nullptr) {
    lower = &w.add(cube, 1, btVector3(0, 0, 0));
    upper = &w.add(upperShape ? std::move(upperShape) : cube, 1, btVector3(0, 0, kHeight));
    w.world.performDiscreteCollisionDetection();
    EXPECT_GE(points([](const btManifoldPoint&) {}), 3) << "nothing to hold";
    EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
    Base::detect();  // a dispatcher that is not told where steps end does not expect the balls in the first
  }

  void detect() {
    Base::detect();
    ASSERT_EQ(w.dispatcher.lastStep().unresolvedPairs, Base::kBusyPairs + 1) << "not held: the test shows nothing";
  }
  // Of the cubes; returns how many.
  int points(const std::function<void(const btManifoldPoint&)>& visit) { return Base::points(*lower, visit); }
};

CAIRN_FRONT_END_SUITE(HeldPairs, EveryFrontEnd);

// Two bodies that turn together do not move against each other: they may be held for long.
TYPED_TEST(HeldPairs, TurnTheirNormalsWithTheBodies) {
  HeldCubes<TypeParam> s;
  s.w.dispatcher.setFinest(bullet::Finest::leaves);  // exact contacts would be carried over
  for (int step = 1; step <= 10; ++step) {
    const btQuaternion turned(btVector3(1, 0, 0), btScalar(0.1) * btScalar(step));
    s.place(*s.lower, btVector3(0, 0, 0), turned);
    s.place(*s.upper, quatRotate(turned, btVector3(0, 0, s.kHeight)), turned);
    s.detect();
    const btVector3 up = quatRotate(turned, btVector3(0, 0, 1));
    const int count = s.points([&](const btManifoldPoint& p) {
      // Leaves of a cube give its faces' normals up to rounding.
      EXPECT_GT(std::abs(up.dot(p.m_normalWorldOnB)), 0.9999) << "step " << step;
      EXPECT_NEAR(p.m_distance1, -0.0005, 0.0001) << "step " << step;
    });
    EXPECT_GE(count, 3) << "step " << step;
  }
}

// Bullet refreshes the points of a compound's children before anybody is asked, and would drop what slid.
TYPED_TEST(HeldPairs, OfACompoundKeepPointsThatSlide) {
  const auto child = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  const auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform::getIdentity(), child.get());
  HeldCubes<TypeParam> s(compound);
  // Four steps of 0.4 % of the size, where contacts are looked for up to 0.2 %; after 3 % they no longer count.
  for (int step = 1; step <= 4; ++step) {
    s.place(*s.upper, btVector3(btScalar(0.007) * btScalar(step), 0, s.kHeight));
    s.detect();
    EXPECT_GE(s.points([](const btManifoldPoint&) {}), 3) << "step " << step;
  }
}

// The fallback for outdated contacts is a contact: the user is told of no end.
TYPED_TEST(HeldPairs, StayInContactWhileTheirSpheresStandIn) {
  static int ended = 0;
  HeldCubes<TypeParam> s;
  static const btRigidBody* lower = nullptr;
  lower = s.lower;
  ended = 0;
  int standIns = 0, warm = 0;
  for (int step = 1; step <= 20; ++step) {
    s.place(*s.upper, btVector3(btScalar(0.03) * btScalar(step), 0, s.kHeight));
    gContactEndedCallback = [](btPersistentManifold* const& m) {
      ended += m->getBody0() == lower || m->getBody1() == lower;
    };
    s.detect();
    gContactEndedCallback = nullptr;
    const int count = s.points([&](const btManifoldPoint& p) { warm += p.getLifeTime() > 5; });
    EXPECT_GE(count, 1) << "step " << step;
    standIns += count == 1;
  }
  EXPECT_GT(standIns, 10) << "the spheres of the whole bodies never stood in: the test shows nothing";
  EXPECT_GT(warm, 10) << "the point is a new one in every step";
  // The other manifolds of the pair end once, when their points have lapsed.
  EXPECT_LE(ended, 3);
}

// Separate bodies may touch once they have approached by 0.8 % of the size unseen: the spheres of the
// whole bodies hold from there on, until somebody looks.
TYPED_TEST(HeldPairs, ThatSaidNothingAreHeldBySpheresFromEightThousandthsOn) {
  BusyWorld<TypeParam> s;
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  btRigidBody &lower = s.w.add(cube, 1, btVector3(0, 0, 0)), &upper = s.w.add(cube, 1, btVector3(0, 0, 0));
  const btScalar away = 1 + btScalar(0.1) * cube->size();  // leaves of this tree stick out by half as much
  const auto pointsAt = [&](btScalar height) {
    s.place(upper, btVector3(0, 0, height));
    s.detect();
    return s.points(lower, [](const btManifoldPoint&) {});
  };
  ASSERT_EQ(pointsAt(away), 0) << "not apart";
  ASSERT_TRUE(s.w.dispatcher.setBudget({1, {}}).ok());
  EXPECT_EQ(pointsAt(away - btScalar(0.007) * cube->size()), 0) << "held before it had to be";
  for (const double way : {0.009, 0.012, 0.016, 0.02, 0.025, 0.029}) {
    EXPECT_GE(pointsAt(away - btScalar(way) * cube->size()), 1) << way << " of the size nearer";
    ASSERT_EQ(s.w.dispatcher.lastStep().unresolvedPairs, s.kBusyPairs + 1) << "not held: the test shows nothing";
  }
  ASSERT_TRUE(s.w.dispatcher.setBudget({}).ok());
  EXPECT_EQ(pointsAt(away - btScalar(0.012) * cube->size()), 0) << "spheres outlived an answer";
}

// Else bodies would rest on spheres for as long as others' contacts may be more wrong than silence was.
TYPED_TEST(HeldPairs, ThatSaidNothingAreUrgentBehindTheirSpheres) {
  BulletWorld<TypeParam> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4))), round = treeShape(plainTree(ball(0.5, 8)));
  btRigidBody* balls[4];
  for (int i = 0; i < 4; ++i) balls[i] = &w.add(round, 1, btVector3(20 + btScalar(0.9) * btScalar(i), 0, 0));
  btRigidBody &lower = w.add(cube, 1, btVector3(0, 0, 0)), &upper = w.add(cube, 1, btVector3(0, 0, 0));
  int step = 0;
  // Balls in each other that sway, by less than what their answers hold for.
  const auto pointsAt = [&](double away) {
    ++step;
    for (int i = 0; i < 4; ++i) {
      const btScalar sway = btScalar(0.007) * btScalar((step + i) % 2);
      balls[i]->setWorldTransform(
          btTransform(btQuaternion::getIdentity(), btVector3(20 + btScalar(0.9) * btScalar(i), sway, 0)));
    }
    upper.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 1 + btScalar(away) * cube->size())));
    w.world.performDiscreteCollisionDetection();
    int points = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      if (m.getBody0() == &lower || m.getBody1() == &lower) points += m.getNumContacts();
    }
    return points;
  };
  ASSERT_EQ(pointsAt(0.1), 0) << "not apart";
  ASSERT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  for (int i = 0; i < 2; ++i) (void)pointsAt(0.1);
  ASSERT_GE(pointsAt(0.09), 1) << "spheres do not stand in: the test shows nothing";
  ASSERT_TRUE(w.dispatcher.setBudget({6000, {}}).ok());  // for one pair, about
  int steps = 1;
  while (steps < 30 && pointsAt(0.09) > 0) ++steps;
  EXPECT_LE(steps, 4) << "as many as there are other pairs, and one";
}

// Nothing stands in on a plane where operations are counted: it is looked at.
TYPED_TEST(HeldPairs, ThatSaidNothingOnAPlaneAreAskedFromEightThousandthsOn) {
  BusyWorld<TypeParam> s;
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  s.w.add(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(-5)), 0, btVector3(0, 0, 0));
  btRigidBody& body = s.w.add(cube, 1, btVector3(0, 0, 0));
  const auto depthAt = [&](double separation) {
    s.place(body, btVector3(0, 0, btScalar(separation) * cube->size() - btScalar(4.5)));
    s.detect();
    double depth = 0;
    s.points(body, [&](const btManifoldPoint& point) { depth = std::max(depth, -double(point.getDistance())); });
    return depth / double(cube->size());
  };
  ASSERT_EQ(depthAt(0.004), 0) << "not apart";
  ASSERT_TRUE(s.w.dispatcher.setBudget({1, {}}).ok());
  for (const double deep : {0.005, 0.01, 0.02}) {
    EXPECT_NEAR(depthAt(-deep), deep, 1e-4);  // of corners: leaves of a cube give its faces up to rounding
    ASSERT_TRUE(s.w.dispatcher.setBudget({}).ok());
    ASSERT_EQ(depthAt(0.004), 0) << "not apart again";
    ASSERT_TRUE(s.w.dispatcher.setBudget({1, {}}).ok());
  }
}

// The cost of measuring leaf pairs is held back from refinement, which takes several steps: though it is more than a
// step has, in the end there is an answer.
TYPED_TEST(HeldPairs, ThatCostMoreThanAStepHasComeToAnAnswer) {
  for (const std::int64_t operations : {20, 100, 400}) {
    BulletWorld<TypeParam> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.dispatcher.setFinest(bullet::Finest::leaves);
    const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
    btRigidBody* bodies[2];
    for (int i = 0; i < 2; ++i) bodies[i] = &w.add(cube, 1, btVector3(0, 0, btScalar(0.9995) * btScalar(i)));
    w.world.performDiscreteCollisionDetection();
    const std::uint64_t whole = w.dispatcher.lastStep().operations;
    ASSERT_GT(whole, 400U) << "fits into a step: the test shows nothing";
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    bodies[1]->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.02), 0, 0.9995F)));
    std::uint64_t used = 0;
    int steps = 0;
    do {
      w.world.performDiscreteCollisionDetection();
      used += w.dispatcher.lastStep().operations;
      ++steps;
    } while (w.dispatcher.lastStep().unresolvedPairs > 0 && used < 4 * whole);
    EXPECT_EQ(w.dispatcher.lastStep().unresolvedPairs, 0U) << operations << " operations, " << steps << " steps";
    EXPECT_GE(w.dispatcher.lastStep().contacts, 3U) << operations << " operations";
    EXPECT_LE(used, 2 * whole) << operations << " operations, " << steps << " steps";
  }
}

// The next step measures what lay near anew: no more than it has, or little more. Cubes on each other have hundreds of
// leaf pairs that touch.
TYPED_TEST(HeldPairs, ThatCostMoreThanAStepHasStayWithinItOnceAnswered) {
  for (const std::int64_t operations : {100, 400, 2000}) {
    BulletWorld<TypeParam> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.dispatcher.setFinest(bullet::Finest::leaves);
    const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 8)));
    for (int i = 0; i < 2; ++i) w.add(cube, 1, btVector3(0, 0, btScalar(0.9995) * btScalar(i)));
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    // Its bound: a turn's finds, what was known, what was found, and guards.
    constexpr std::uint64_t kBeyond = 320 + 5 * (48 + 32) + 3 * 97;
    std::uint64_t most = 0, used = 0;
    int answered = 0;
    for (int i = 0; i < 2000 && answered < 20; ++i) {
      w.world.performDiscreteCollisionDetection();
      most = std::max(most, w.dispatcher.lastStep().operations);
      used += w.dispatcher.lastStep().operations;
      answered += w.dispatcher.lastStep().unresolvedPairs == 0 ? 1 : 0;
    }
    EXPECT_GT(answered, 0) << operations << " operations: no answer, " << used << " used";
    EXPECT_LE(most, static_cast<std::uint64_t>(operations) + kBeyond) << operations << " operations";
  }
}

// Bowls whose spheres overlapped a little where they stood first: what was allowed there must not drive them apart
// where they are set down, one in the other.
TYPED_TEST(HeldPairs, ThatAreSetDownElsewhereStartAnew) {
  for (const std::int64_t operations : {0, 1}) {
    BulletWorld<TypeParam> w;
    w.world.setGravity(btVector3(0, 0, 0));
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    const auto tree = treeShape(plainTree(bowl(0.4, 0.36, 16)));
    const btVector3 inside(0, 0, btScalar(0.2));
    btRigidBody* bodies[3];
    for (int i = 0; i < 3; ++i) bodies[i] = &w.add(tree, 1, btVector3(btScalar(0.77) * btScalar(i - 1), 0, 0));
    for (btRigidBody* body : bodies) body->setActivationState(DISABLE_DEACTIVATION);
    w.step(20);
    ASSERT_GT(w.dispatcher.lastStep().unresolvedPairs, 0U) << "resolved: the test shows nothing";
    bodies[0]->setWorldTransform(btTransform(btQuaternion::getIdentity(), inside));
    bodies[0]->setInterpolationWorldTransform(bodies[0]->getWorldTransform());
    w.step(60);
    ASSERT_GT(w.dispatcher.lastStep().unresolvedPairs, 0U) << "resolved: the test shows nothing";
    const btScalar way = (bodies[0]->getWorldTransform().getOrigin() - inside).length();
    EXPECT_LT(way, kSpeculativeFraction * tree->size()) << operations << " operations";
  }
}

// Also where a new traversal begins in every step and does not end: the last answer still stands.
TEST(HeldPairs_Statistics, BoundTheErrorByTheWholeWaySinceTheAnswer) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto tree = treeShape(plainTree(ball(0.5, 8)));
  w.add(tree, 1, btVector3(0, 0, 0));
  btRigidBody& moving = w.add(tree, 1, btVector3(btScalar(0.99), 0, 0));
  w.world.performDiscreteCollisionDetection();
  const double answer = w.dispatcher.lastStep().worstErrorFraction;
  ASSERT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  for (int step = 1; step <= 4; ++step) {
    const double moved = 0.005 * (step + 1);  // beyond what cached contacts allow
    const btScalar aside = btScalar(moved) * tree->size();
    moving.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.99), aside, 0)));
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.lastStep().unresolvedPairs, 1U) << "resolved: the test shows nothing";
    EXPECT_GE(w.dispatcher.lastStep().worstErrorFraction, answer + moved - 1e-5) << "step " << step;
  }
}

// A pair that is new was apart a step ago, unless its bodies were set down where they are: nobody has looked there.
TEST(HeldPairs_Statistics, OfBodiesSetDownInEachOtherErrByTheirWholeSpheres) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  w.add(cube, 1, btVector3(0, 0, 0));
  w.add(cube, 1, btVector3(btScalar(0.6), 0, 0));
  ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  const double oneSphere = double(cube->tree().error(kRootNode)) / double(cube->size());
  for (int step = 1; step <= 4; ++step) {
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.lastStep().unresolvedPairs, 1U) << "resolved: the test shows nothing";
    EXPECT_GE(w.dispatcher.lastStep().worstErrorFraction, 2 * oneSphere - 1e-5) << "step " << step;
  }
}

}  // namespace
}  // namespace cairn::test::held_pair_test
