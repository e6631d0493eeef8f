// SPDX-License-Identifier: Zlib
// A non-finite body, or one about to become so, harms no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "front_ends.h"

namespace cairn::test::broken_body_test {
namespace {

constexpr btScalar kNan = std::numeric_limits<btScalar>::quiet_NaN(), kInf = std::numeric_limits<btScalar>::infinity();
constexpr btScalar kRadius = btScalar(0.3);
// A body that falls from the place of the upper one arrives slower.
constexpr btScalar kFallSpeed = btScalar(3.5);

enum class Harm { place, axes, speed, spin, force, torque };

void harm(btRigidBody& body, Harm how) {
  btTransform at = body.getWorldTransform();
  switch (how) {
    case Harm::place:
      at.setOrigin(btVector3(0, kNan, 0));
      return body.setWorldTransform(at);
    case Harm::axes:
      at.getBasis()[1].setX(kNan);
      return body.setWorldTransform(at);
    case Harm::speed:
      return body.setLinearVelocity(btVector3(0, 0, kInf));
    case Harm::spin:
      return body.setAngularVelocity(btVector3(kNan, 0, 0));
    case Harm::force:
      return body.applyCentralForce(btVector3(0, -kInf, 0));
    case Harm::torque:
      return body.applyTorque(btVector3(0, 0, kInf));
  }
}

std::shared_ptr<btCompoundShape> dumbbellOf(btCollisionShape& first, btCollisionShape& second, btScalar aside) {
  auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(aside, 0, 0)), &first);
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(-aside, 0, 0)), &second);
  return compound;
}

CAIRN_FRONT_END_SUITE(BrokenBody, EveryFrontEnd);

TYPED_TEST(BrokenBody, HarmsNoneOfThoseItTouches) {
  const auto tree = plainTree(ball(double(kRadius), 6));
  for (const Harm how : {Harm::place, Harm::axes, Harm::speed, Harm::spin, Harm::force, Harm::torque}) {
    SCOPED_TRACE(int(how));
    BulletWorld<TypeParam> w;
    w.addGround();
    btRigidBody& broken = w.add(treeShape(tree), 1, btVector3(0, 0, kRadius));
    btRigidBody& above = w.add(treeShape(tree), 1, btVector3(0, 0, 3 * kRadius));
    for (btRigidBody* body : {&broken, &above}) body->setActivationState(DISABLE_DEACTIVATION);
    w.step(5);
    ASSERT_GT(w.dispatcher.lastStep().contacts, 1U) << "they do not touch: the test shows nothing";
    ASSERT_EQ(w.dispatcher.lastStep().nonFinitePairs, 0U);
    harm(broken, how);
    w.step();
    EXPECT_GT(w.dispatcher.lastStep().nonFinitePairs, 0U);
    w.step(60);
    ASSERT_TRUE(isSane(above));
    EXPECT_LT(above.getLinearVelocity().length(), kFallSpeed) << "something threw it";
    EXPECT_GT(above.getWorldTransform().getOrigin().z(), 0);

    // And on it goes.
    broken.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(1, 0, kRadius)));
    broken.setInterpolationWorldTransform(broken.getWorldTransform());
    for (const auto& stop : {&btRigidBody::setLinearVelocity, &btRigidBody::setAngularVelocity})
      (broken.*stop)(btVector3(0, 0, 0));
    broken.clearForces();
    broken.updateInertiaTensor();
    broken.forceActivationState(DISABLE_DEACTIVATION);
    w.step(30);
    EXPECT_TRUE(isSane(broken));
    EXPECT_EQ(w.dispatcher.lastStep().nonFinitePairs, 0U);
    EXPECT_NEAR(broken.getWorldTransform().getOrigin().z(), kRadius, 0.05 * double(kRadius));
  }
}

TYPED_TEST(BrokenBody, IsToldOnce) {
  BulletWorld<TypeParam> w;
  w.addGround();
  const auto tree = plainTree(ball(double(kRadius), 6));
  btRigidBody& broken = w.add(treeShape(tree), 1, btVector3(0, 0, kRadius));
  w.add(treeShape(tree), 1, btVector3(0, 0, 3 * kRadius));  // Bullet asks no more about what touches nothing awake
  w.step();
  testing::internal::CaptureStderr();
  harm(broken, Harm::place);
  w.step(3);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(told.find("NaN or infinite"), told.rfind("NaN or infinite"));
  EXPECT_NE(told.find("NaN or infinite"), std::string::npos) << told;
}

// Bullet looks neither at the forces on a static body nor at its speed, and never takes them away.
TYPED_TEST(BrokenBody, StaticBodiesGoOnHolding) {
  const auto tree = plainTree(ball(double(kRadius), 6));
  const std::shared_ptr<btCollisionShape> grounds[] = {
      std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0.5)),
      std::make_shared<btBoxShape>(btVector3(2, 2, btScalar(0.5))), treeShape(plainTree(cuboid({4, 4, 1}, 4)))};
  for (const auto& ground : grounds)
    for (const Harm how : {Harm::speed, Harm::spin, Harm::force, Harm::torque}) {
      SCOPED_TRACE(std::string(ground->getName()) + ", harm " + std::to_string(int(how)));
      BulletWorld<TypeParam> w;
      btRigidBody& below = w.add(ground, 0, btVector3(0, 0, btScalar(-0.5)));
      btRigidBody& body = w.add(treeShape(tree), 1, btVector3(btScalar(0.1), 0, 2 * kRadius));
      harm(below, how);
      w.step(60);
      EXPECT_EQ(w.dispatcher.lastStep().nonFinitePairs, 0U);
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), kRadius, 0.05 * double(kRadius));
    }
}

using NearCallback = void (*)(btBroadphasePair&, btCollisionDispatcher&, const btDispatcherInfo&);

// Bullet keeps a compound's child that it does not ask about, with the points it had, where boxes overlap in the world
// and not in the compound's frame.
template <class DispatcherType>
void breakDumbbellUnderOthers(unsigned seed, NearCallback near) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const auto cube = plainTree(cuboid({0.5, 0.4, 0.3}, 2)), round = plainTree(ball(0.25, 6));
  const auto first = treeShape(round), second = treeShape(cube);
  const auto dumbbell = dumbbellOf(*first, *second, btScalar(0.2));
  std::mt19937 random(seed);
  const auto pick = [&](unsigned n) { return int(random() % n); };
  const auto turn = [&] {
    const btVector3 axis(1, btScalar(pick(3)), btScalar(pick(3)));
    return btQuaternion(axis.normalized(), btScalar(pick(6)));
  };
  BulletWorld<DispatcherType> w;
  w.dispatcher.setNearCallback(near);
  w.addGround();
  ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  btRigidBody& broken = w.add(dumbbell, 1, btVector3(0, 0, btScalar(0.4)), turn());
  std::vector<btRigidBody*> others;
  for (int i = 0; i < 6; ++i) {
    const btVector3 at(btScalar(0.4 * (i % 3) - 0.4), btScalar(0.02 * i - 0.1), btScalar(0.9 + 0.5 * (i / 2)));
    others.push_back(&w.add(treeShape(i % 2 != 0 ? cube : round), 1, at, turn()));
  }
  for (btRigidBody* body : others) body->setActivationState(DISABLE_DEACTIVATION);
  broken.setActivationState(DISABLE_DEACTIVATION);
  w.step(40 + pick(60));
  harm(broken, Harm::force);
  w.step(30);
  for (const btRigidBody* body : others) ASSERT_TRUE(isSane(*body));
}

TYPED_TEST(BrokenBody, OfSeveralTreesHarmsNoneOfThoseItTouches) {
  for (unsigned seed = 0; seed < 240 && !this->HasFatalFailure(); ++seed)
    breakDumbbellUnderOthers<TypeParam>(seed, btCollisionDispatcher::defaultNearCallback);
}

// As games that watch contacts do: Bullet's own callback, but for the class of the result.
void watchingNearCallback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  struct Watched final : btManifoldResult {
    using btManifoldResult::btManifoldResult;
  };
  const auto& object0 = *static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject);
  const auto& object1 = *static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
  if (!dispatcher.needsCollision(&object0, &object1)) return;
  const btCollisionObjectWrapper wrap0(nullptr, object0.getCollisionShape(), &object0, object0.getWorldTransform(), -1,
                                       -1);
  const btCollisionObjectWrapper wrap1(nullptr, object1.getCollisionShape(), &object1, object1.getWorldTransform(), -1,
                                       -1);
  if (!pair.m_algorithm)
    pair.m_algorithm = dispatcher.findAlgorithm(&wrap0, &wrap1, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  if (!pair.m_algorithm) return;
  Watched result(&wrap0, &wrap1);
  pair.m_algorithm->processCollision(&wrap0, &wrap1, info, &result);
}

// One in thousands shows it.
TYPED_TEST(BrokenBody, OfSeveralTreesHarmsNoneWhoeverWatches) {
  if (std::is_same_v<TypeParam, InstalledOnDispatcher>)
    GTEST_SKIP() << "knows of steps by plain results alone: a limit that docs/limits.md names";
  for (unsigned seed = 1000; seed < 1100 && !this->HasFatalFailure(); ++seed)
    breakDumbbellUnderOthers<TypeParam>(seed, watchingNearCallback);
}

// A user's near callback may do that after a pair was asked about.
TEST(BrokenBody_Compound, MayBreakWhileBulletAsks) {
  static btRigidBody* target;
  static bool breaks;
  for (const int budget : {-1, 0, 50}) {
    BulletWorld<> w;
    if (budget >= 0) ASSERT_TRUE(w.dispatcher.setBudget({budget, {}}).ok());
    const auto cube = treeShape(plainTree(cuboid({0.5, 0.4, 0.3}, 2)));
    w.add(std::make_shared<btBoxShape>(btVector3(2, 2, btScalar(0.5))), 0, btVector3(0, 0, btScalar(-0.5)));
    target = &w.add(dumbbellOf(*cube, *cube, btScalar(0.3)), 1, btVector3(0, 0, btScalar(0.16)));
    btRigidBody& above = w.add(treeShape(cube->sharedTree()), 1, btVector3(0, 0, btScalar(0.47)));
    for (btRigidBody* body : {target, &above}) body->setActivationState(DISABLE_DEACTIVATION);
    breaks = false;
    w.dispatcher.setNearCallback([](btBroadphasePair& pair, btCollisionDispatcher& d, const btDispatcherInfo& info) {
      btCollisionDispatcher::defaultNearCallback(pair, d, info);
      if (breaks) target->setLinearVelocity(btVector3(0, 0, kInf));
    });
    w.step(60);
    breaks = true;
    w.step(2);
    breaks = false;
    w.step(20);
    EXPECT_FALSE(isSane(*target)) << "the test shows nothing";
  }
}

struct Anything final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*,
                           int, int) override {
    return 0;
  }
};

// A callback for an ended contact may ask about other compounds, which makes pairs.
TEST(BrokenBody_Compound, CallbacksMayAsk) {
  static BulletWorld<>* world;
  static btCollisionObject* probe;
  static int asks;  // so many times a step, at most
  const auto round = treeShape(plainTree(ball(0.25, 4))), cube = treeShape(plainTree(cuboid({0.5, 0.4, 0.3}, 1)));
  const auto dumbbell = dumbbellOf(*round, *cube, btScalar(0.2));
  btCompoundShape many;
  for (int i = 0; i < 100; ++i)
    many.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.002 * i), 0, 0)), round.get());
  btCollisionObject asked;
  asked.setCollisionShape(&many);
  asked.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.6))));
  probe = &asked;
  gContactEndedCallback = [](btPersistentManifold* const&) {
    Anything anything;
    if (asks-- > 0) world->world.contactTest(probe, anything);
  };
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    BulletWorld<> w;
    world = &w;
    asks = 0;
    w.addGround();
    ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
    std::vector<btRigidBody*> broken, others;
    for (int i = 0; i < 24; ++i) {
      const btVector3 at(btScalar(0.42 * (i % 3) - 0.4), btScalar(0.42 * (i / 3 % 3) - 0.4),
                         btScalar(0.4 + 0.45 * (i / 9)));
      const btVector3 axis(1, btScalar(random() % 3), btScalar(random() % 3));
      btRigidBody& body = w.add(dumbbell, 1, at, btQuaternion(axis.normalized(), btScalar(random() % 6)));
      body.setActivationState(DISABLE_DEACTIVATION);
      (i % 3 == 1 ? broken : others).push_back(&body);
    }
    w.step(20 + int(random() % 30));
    for (btRigidBody* body : broken) harm(*body, Harm::force);
    for (int i = 0; i < 10; ++i) {
      asks = 30;
      w.step();
    }
    asks = 0;
    for (const btRigidBody* body : others) EXPECT_TRUE(isSane(*body));
  }
  gContactEndedCallback = nullptr;
}

}  // namespace
}  // namespace cairn::test::broken_body_test
