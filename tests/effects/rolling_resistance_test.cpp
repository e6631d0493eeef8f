// SPDX-License-Identifier: Zlib
// Resistance to rolling and spinning, against the textbook.
#include "cairn/effects/rolling_resistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "cairn/bullet/ordered_solver.h"
#include "cairn/effects/friction.h"
#include "effect_world.h"
#include "slope_world.h"

namespace cairn::test::rolling_resistance_test {
namespace {

using effects::RollingResistance;

constexpr btScalar kRadius = btScalar(0.5);

struct Case {
  btScalar massKg = 10, stepsPerSecond = 240;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.massKg << " kg at " << c.stepsPerSecond << " steps a second";
}

struct Rolling {
  SlopeWorld world;
  btRigidBody* ball = nullptr;

  explicit Rolling(const RollingResistance::Lengths& lengths, const Case& c = {}, btScalar slope = 0)
      : world(slope, c.stepsPerSecond) {
    world.add<effects::Friction>(effects::PairTable<btScalar>(btScalar(0.8)));
    world.add<RollingResistance>(effects::PairTable<RollingResistance::Lengths>(lengths));
    ball = &world.addBody(std::make_shared<btSphereShape>(kRadius), c.massKg,
                          btVector3(btSin(slope), 0, btCos(slope)) * kRadius);
  }
  void roll(const btVector3& velocity) const {
    ball->setLinearVelocity(velocity);
    ball->setAngularVelocity(btVector3(0, 0, 1).cross(velocity) / kRadius);
  }
};

/// The laws hold whatever a rock weighs and however long the step: within 2 %, of which a step's pull in 1 s is less
/// than half.
class RollingResistanceOf : public testing::TestWithParam<Case> {};
constexpr btScalar kOfTheLaw = btScalar(0.02);

btScalar decelerationOf(const Case& c, const btVector3& direction) {
  constexpr btScalar kSpeed = 4, kSeconds = 1;
  Rolling rolling({.rolling = btScalar(0.05)}, c);
  rolling.roll(direction * kSpeed);
  rolling.world.run(kSeconds);
  return (kSpeed - rolling.ball->getLinearVelocity().dot(direction)) / kSeconds;
}

TEST_P(RollingResistanceOf, SlowsABallAsTheTextbookSays) {
  const btScalar expected = btScalar(5) / 7 * kGravity * btScalar(0.05) / kRadius;
  EXPECT_NEAR(decelerationOf(GetParam(), btVector3(1, 0, 0)), expected, kOfTheLaw * expected);
  EXPECT_NEAR(decelerationOf(GetParam(), btVector3(1, 1, 0).normalized()), expected, kOfTheLaw * expected)
      << "in every direction the same";
}

// I w' = -length m g with I = 2/5 m r^2.
TEST_P(RollingResistanceOf, SlowsASpinOnTheSpotAsTheTextbookSays) {
  constexpr btScalar kLength = btScalar(0.02), kSpin = 10, kSeconds = 2;
  Rolling rolling({.spinning = kLength}, GetParam());
  rolling.ball->setAngularVelocity(btVector3(0, 0, kSpin));
  rolling.world.run(kSeconds);
  const btScalar expected = kSeconds * kLength * kGravity / (btScalar(0.4) * kRadius * kRadius);
  EXPECT_NEAR(kSpin - rolling.ball->getAngularVelocity().z(), expected, kOfTheLaw * expected);
}

// On a slope the torque of its weight is m g sin r, the resistance at most length m g cos.
TEST_P(RollingResistanceOf, HoldsABallWhereTheSlopeIsLessThanLengthOverRadius) {
  const auto wayOn = [](btScalar tangent) {
    Rolling rolling({.rolling = btScalar(0.1)}, GetParam(), btAtan(tangent));
    const btVector3 start = rolling.ball->getWorldTransform().getOrigin();
    rolling.world.run(2);
    return (rolling.ball->getWorldTransform().getOrigin() - start).length();
  };
  constexpr btScalar kLimit = btScalar(0.1) / kRadius;
  const btScalar angle = btAtan(btScalar(1.1) * kLimit);
  const btScalar acceleration = btScalar(5) / 7 * kGravity * (btSin(angle) - kLimit * btCos(angle));
  EXPECT_LT(wayOn(btScalar(0.9) * kLimit), 1e-2) << "Bullet's iterations leave a creep of a few mm/s";
  EXPECT_NEAR(wayOn(btScalar(1.1) * kLimit), 2 * acceleration, btScalar(0.1) * 2 * acceleration);
}

INSTANTIATE_TEST_SUITE_P(MassesAndSteps, RollingResistanceOf, testing::ValuesIn([] {
                           std::vector<Case> cases;
                           for (const btScalar mass : {btScalar(10), btScalar(1e3), btScalar(1e5)})
                             for (const btScalar rate : {btScalar(60), btScalar(240), btScalar(1000)})
                               cases.push_back({mass, rate});
                           return cases;
                         }()));

btScalar wayOf(btScalar length, btScalar speed) {
  Rolling rolling({.rolling = length});
  rolling.roll(btVector3(speed, 0, 0));
  rolling.world.run(10);
  EXPECT_LT(rolling.ball->getLinearVelocity().length(), 1e-2) << "rests by now";
  return rolling.ball->getWorldTransform().getOrigin().x();
}

TEST(RollingResistance, ABallStopsAfterTheTextbooksWay) {
  constexpr btScalar kLength = btScalar(0.05), kSpeed = 2;
  const btScalar deceleration = btScalar(5) / 7 * kGravity * kLength / kRadius;
  const btScalar expected = kSpeed * kSpeed / (2 * deceleration);
  EXPECT_NEAR(wayOf(kLength, kSpeed), expected, btScalar(0.02) * expected);
}

// With a solver that may do more than Bullet's plain one.
struct OtherWorld {
  struct Other final : btSequentialImpulseConstraintSolver {};
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  Other solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

TEST(RollingResistance, IsRefusedBesideASolverThatMayDoMore) {
  OtherWorld other;
  btDiscreteDynamicsWorld& world = other.world;
  const auto set = effects::EffectSet::create(world).value();
  const Status able = set->canAct(RollingResistance(effects::PairTable<RollingResistance::Lengths>()));
  ASSERT_FALSE(able);
  EXPECT_NE(able.error().message.find("make the world with"), std::string::npos) << able.error().message;
  EXPECT_TRUE(set->canAct(effects::Friction(effects::PairTable<btScalar>())));
}

// Beside it Bullet's own rows resist, as they did before the set had its own.
TEST(RollingResistance, IsBulletsOwnBesideASolverThatMayDoMore) {
  OtherWorld other;
  btDiscreteDynamicsWorld& world = other.world;
  world.setGravity(btVector3(0, 0, -kGravity));
  const auto set = effects::EffectSet::create(world).value();
  set->add(
      std::make_unique<RollingResistance>(effects::PairTable<RollingResistance::Lengths>({.rolling = btScalar(0.05)})));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btSphereShape round(kRadius);
  btRigidBody ground(0, nullptr, &plane);
  btVector3 inertia;
  round.calculateLocalInertia(10, inertia);
  btRigidBody ball(10, nullptr, &round, inertia);
  ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, kRadius)));
  world.addRigidBody(&ground);
  world.addRigidBody(&ball);
  set->describe(ground, {.material = kSoil});
  set->addBody(ball, {.material = kRock});
  ball.setLinearVelocity(btVector3(2, 0, 0));
  ball.setAngularVelocity(btVector3(0, 2 / kRadius, 0));
  for (int i = 0; i < 240; ++i) world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_LT(ball.getLinearVelocity().x(), 1.5);
  set->removeBody(ball);
  world.removeRigidBody(&ball);
  world.removeRigidBody(&ground);
}

// A body that lies flat does not roll: torques must not upset what friction and normals balance.
TEST_P(RollingResistanceOf, LetsABoxLieOnASlope) {
  constexpr btScalar kSlope = btScalar(0.35);
  Rolling rolling({.rolling = btScalar(0.1), .spinning = btScalar(0.02)}, GetParam(), kSlope);
  const btVector3 up(btSin(kSlope), 0, btCos(kSlope));
  btRigidBody& box = rolling.world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.5))),
                                           GetParam().massKg, btVector3(0, 20, 0) + up * btScalar(0.5));
  box.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), kSlope), box.getWorldTransform().getOrigin()));
  rolling.world.run(2);
  const btVector3 start = box.getWorldTransform().getOrigin();
  rolling.world.run(10);
  EXPECT_LT((box.getWorldTransform().getOrigin() - start).length(), 1e-3);
}

// The set's own solver does to them what Bullet's does.
TEST(RollingResistance, LeavesBodiesThatItDoesNotConcernTheirBits) {
  const auto hashWith = [](btScalar length) {
    EffectWorld w;
    effects::PairTable<RollingResistance::Lengths> lengths;
    lengths.set(kIce, kSoil, {.rolling = length, .spinning = length});
    w.effect<RollingResistance>(lengths);
    w.ground(kSoil);
    const auto shape = std::make_shared<btBoxShape>(btVector3(1, btScalar(0.7), btScalar(0.5)));
    btRigidBody& box = w.join(w.bullet.add(shape, 30, btVector3(0, 0, 3)), 1, kRock);
    box.setAngularVelocity(btVector3(1, 2, 3));
    btRigidBody& ball =
        w.join(w.bullet.add(std::make_shared<btSphereShape>(kRadius), 30, btVector3(500, 0, kRadius)), 1, kIce);
    ball.setLinearVelocity(btVector3(5, 0, 0));
    StateHash hash;
    for (int i = 0; i < 480; ++i) {
      w.step(1, btScalar(1) / 240);
      addState(hash, box);
    }
    return std::pair(hash.hex(), ball.getLinearVelocity().x());
  };
  const auto without = hashWith(0), with = hashWith(btScalar(0.1));
  EXPECT_EQ(with.first, without.first);
  EXPECT_LT(with.second, without.second) << "it acts on the ball";
}

/// The hull of so many points spread evenly over a sphere.
std::shared_ptr<btConvexHullShape> roundHull(int points) {
  auto hull = std::make_shared<btConvexHullShape>();
  const double golden = std::acos(-1.0) * (3 - std::sqrt(5.0));
  for (int i = 0; i < points; ++i) {
    const double z = 1 - (2 * i + 1.0) / points, r = std::sqrt(1 - z * z);
    hull->addPoint(btVector3(btScalar(r * std::cos(golden * i)), btScalar(r * std::sin(golden * i)), btScalar(z)) *
                   kRadius);
  }
  hull->setMargin(0);
  return hull;
}

// It loses energy at its edges as well, by its speed squared: what is more with a length than without is the
// resistance, but for the edges that are passed more slowly and fewer.
TEST(RollingResistance, SlowsRocksOfManyFacesByAsMuch) {
  constexpr btScalar kSpeed = 2, kSeconds = btScalar(0.5), kLength = btScalar(0.05);
  const auto speedOf = [&](btScalar mass, btScalar length) {
    SlopeWorld world;
    world.add<effects::Friction>(effects::PairTable<btScalar>(btScalar(0.8)));
    world.add<RollingResistance>(effects::PairTable<RollingResistance::Lengths>({.rolling = length}));
    btRigidBody& rock = world.addBody(roundHull(4000), mass, btVector3(0, 0, kRadius));
    const btScalar moment = btScalar(0.4) * mass * kRadius * kRadius;
    rock.setMassProps(mass, btVector3(moment, moment, moment));
    rock.updateInertiaTensor();
    rock.setLinearVelocity(btVector3(kSpeed, 0, 0));
    rock.setAngularVelocity(btVector3(0, kSpeed / kRadius, 0));
    world.run(kSeconds);
    return rock.getLinearVelocity().x();
  };
  const auto ratio = [&](btScalar mass) {
    const btScalar expected = btScalar(5) / 7 * kGravity * kLength / kRadius;
    return (speedOf(mass, 0) - speedOf(mass, kLength)) / kSeconds / expected;
  };
  const btScalar light = ratio(10);
  EXPECT_NEAR(light, 1, 0.05);
  for (const btScalar mass : {btScalar(52), btScalar(523), btScalar(1387), btScalar(1e5)})
    EXPECT_NEAR(ratio(mass), light, 0.01) << mass << " kg; rounding decides which faces it rolls over";
}

/// A ball's speed a second after it rolled at 4 m/s, in a world of this solver.
template <class Solver>
btScalar speedAfterASecond() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  Solver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -kGravity));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btSphereShape sphere(kRadius);
  btRigidBody ground(0, nullptr, &plane), ball(1000, nullptr, &sphere, btVector3(100, 100, 100));
  ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, kRadius)));
  ball.setLinearVelocity(btVector3(4, 0, 0));
  ball.setAngularVelocity(btVector3(0, 4 / kRadius, 0));
  ball.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&ground);
  world.addRigidBody(&ball);
  const auto set = effects::EffectSet::create(world).value();
  set->add(
      std::make_unique<RollingResistance>(effects::PairTable<RollingResistance::Lengths>({.rolling = btScalar(0.05)})));
  set->addBody(ball, {.material = kRock});
  set->describe(ground, {.material = kSoil});
  for (int i = 0; i < 240; ++i) world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  world.removeRigidBody(&ball);
  world.removeRigidBody(&ground);
  return ball.getLinearVelocity().x();
}

TEST(RollingResistance, ActsBesideASolverThatKeepsManifoldsInOrder) {
  const btScalar plain = speedAfterASecond<btSequentialImpulseConstraintSolver>();
  EXPECT_NEAR(4 - plain, btScalar(5) / 7 * kGravity * btScalar(0.1), 0.02);
  EXPECT_EQ(speedAfterASecond<bullet::OrderedSolver<>>(), plain);
}

TEST(RollingResistance, LongerArmShorterWay) {
  EXPECT_LT(wayOf(btScalar(0.1), 2), btScalar(0.6) * wayOf(btScalar(0.05), 2));
}

TEST(RollingResistance, SpinningOnTheSpotDiesAwayOnlyWithItsOwnLength) {
  Rolling rolling({.rolling = btScalar(0.1)});
  rolling.ball->setAngularVelocity(btVector3(0, 0, 10));
  rolling.world.run(2);
  EXPECT_NEAR(rolling.ball->getAngularVelocity().z(), 10, 1e-3);
}

}  // namespace
}  // namespace cairn::test::rolling_resistance_test
