// SPDX-License-Identifier: Zlib
// Pairs for which a step has nothing left: what they said last follows their bodies.
#include <gtest/gtest.h>

#include <functional>

#include "front_ends.h"

namespace cairn::test::held_pair_test {
namespace {

using bullet::kSpeculativeFraction;

// A cube of a metre on another one, half a millimetre in it; nothing moves but by hand. Far away eight balls are in
// each other and never where they were: with a budget of one operation their pairs are more urgent for some twenty
// steps, and the cubes are held.
template <class DispatcherType>
struct HeldCubes {
  static constexpr btScalar kHeight = btScalar(0.9995);
  static constexpr int kBalls = 8;
  static constexpr std::uint32_t kPairs = kBalls * (kBalls - 1) / 2 + 1;

  BulletWorld<DispatcherType> w;
  std::shared_ptr<bullet::SphereTreeShape> cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  btRigidBody *lower = nullptr, *upper = nullptr;

  explicit HeldCubes(std::shared_ptr<btCollisionShape> upperShape = nullptr) {
    w.world.setGravity(btVector3(0, 0, 0));
    const auto round = treeShape(plainTree(ball(0.5, 8)));
    for (int i = 0; i < kBalls; ++i) balls_.push_back(&w.add(round, 1, btVector3(20 + 2 * btScalar(i), 0, 0)));
    lower = &w.add(cube, 1, btVector3(0, 0, 0));
    upper = &w.add(upperShape ? std::move(upperShape) : cube, 1, btVector3(0, 0, kHeight));
    w.world.performDiscreteCollisionDetection();
    EXPECT_GE(points([](const btManifoldPoint&) {}), 3) << "nothing to hold";
    EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
    stir();  // a dispatcher that is not told where steps end does not expect the balls in the first
  }

  void detect() {
    stir();
    ASSERT_EQ(w.dispatcher.lastStep().unresolvedPairs, kPairs) << "not held: the test shows nothing";
  }
  void place(btRigidBody& body, const btVector3& at, const btQuaternion& turned = btQuaternion::getIdentity()) {
    body.setWorldTransform(btTransform(turned, at));
  }
  // Of the cubes; returns how many.
  int points(const std::function<void(const btManifoldPoint&)>& visit) {
    int count = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      if (m.getBody0() != lower && m.getBody1() != lower) continue;
      for (int k = 0; k < m.getNumContacts(); ++k, ++count) visit(m.getContactPoint(k));
    }
    return count;
  }

 private:
  void stir() {
    ++step_;
    for (int i = 0; i < kBalls; ++i)
      place(*balls_[static_cast<std::size_t>(i)], btVector3(20, btScalar(0.1) * btScalar((i * step_) % kBalls), 0));
    w.world.performDiscreteCollisionDetection();
  }

  std::vector<btRigidBody*> balls_;
  int step_ = 0;
};

CAIRN_FRONT_END_SUITE(HeldPairs, EveryFrontEnd);

// Two bodies that turn together do not move against each other: they may be held for long.
TYPED_TEST(HeldPairs, TurnTheirNormalsWithTheBodies) {
  HeldCubes<TypeParam> s;
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

// What stands in for contacts that no longer count is a contact: the user is told of no end.
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

// Bowls whose spheres overlapped a little where they stood first: what was allowed there must not drive them apart
// where they are set down, one in the other.
TYPED_TEST(HeldPairs, ThatAreSetDownElsewhereStartAnew) {
  for (const std::int64_t operations : {0, 1, 200}) {
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
    const double moved = 0.005 * (step + 1);  // beyond what kept answers allow
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
