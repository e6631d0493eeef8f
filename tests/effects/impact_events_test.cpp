// SPDX-License-Identifier: Zlib
// Which blows are reported and which are dropped, and that reports change nothing.
#include "cairn/effects/impact_events.h"

#include "effect_world.h"

namespace cairn::test::impact_events_test {
namespace {

using effects::ImpactEvents;
using Event = ImpactEvents::Event;

constexpr btScalar kStep = btScalar(1) / 240;
constexpr effects::MaterialId kRock = 0, kSoil = 1;

/// A light and a heavy ball fall from the same height and stay down.
struct Fall : EffectWorld {
  Fall() { ground(kSoil); }
  btRigidBody& light = ball(btScalar(0.2), 1, btVector3(0, 0, btScalar(1.2)), btVector3(0, 0, 0));
  btRigidBody& heavy = ball(btScalar(0.2), 10, btVector3(3, 0, btScalar(1.2)), btVector3(0, 0, 0));
};

TEST(ImpactEvents, TellsOfBlowsAboveTheThresholds) {
  Fall w;
  ImpactEvents& events = w.effect<ImpactEvents>(ImpactEvents::Options{.dustImpulse = 20, .soundImpulse = 2});
  w.step(240, kStep);
  std::vector<Event> told;
  events.events().takeInto(told);
  ASSERT_EQ(told.size(), 3U);
  const btScalar speed = btSqrt(2 * kGravity), late = 2 * kGravity * kStep;
  int dust = 0;
  for (const Event& event : told) {
    const bool isHeavy = event.place.x() > 1;
    EXPECT_EQ(std::max(event.bodyIds[0], event.bodyIds[1]), isHeavy ? 1 : 0);
    EXPECT_EQ(std::min(event.bodyIds[0], event.bodyIds[1]), -1) << "the ground has no id";
    EXPECT_EQ(event.materials[0] + event.materials[1], kRock + kSoil);
    EXPECT_NEAR(event.closingSpeed, speed, late);
    // Stopped in a step, and pushed out of the ground in it: Bullet adds a fifth of the depth, at most a step's way.
    EXPECT_NEAR(event.impulse, (isHeavy ? 10 : 1) * speed, (isHeavy ? 10 : 1) * (speed / 5 + late));
    dust += event.kind == ImpactEvents::Kind::dust ? 1 : 0;
    EXPECT_TRUE(event.kind == ImpactEvents::Kind::sound || isHeavy);
  }
  EXPECT_EQ(dust, 1);
  EXPECT_EQ(events.events().size(), 0U) << "taken";
}

/// Wants to see every contact and changes none, so that none is left out because it cannot be part of a blow.
class Onlooker final : public effects::Effect, effects::MaterialHook {
 public:
  std::string_view name() const override { return "onlooker"; }
  effects::Hooks hooks() override { return {.material = this}; }

 private:
  std::uint32_t changeContacts(std::span<effects::Contact>, const effects::Step&) override { return 0; }
};

/// Soil on one side, rock on the other.
struct HalfRock final : effects::MaterialMap {
  effects::MaterialId at(const btVector3& place) const override { return place.x() > 0 ? kRock : kSoil; }
};

/// Bodies of several manifolds each, that fall onto each other and onto a ground of two materials, and come to rest.
struct Tumble : EffectWorld {
  Tumble() {
    const btVector3 below(0, 0, btScalar(-0.5));
    btRigidBody& slab = bullet.add(treeShape(plainTree(cuboid({8, 8, 1}, 6))), 0, below);
    set->describe(slab, {.map = &halfRock});
    const auto shape = treeShape(plainTree(cuboid({1, 0.6, 0.4}, 2)));
    for (int i = 0; i < 12; ++i) {
      const btVector3 place(btScalar(0.3) * btScalar(i % 3), btScalar(0.2) * btScalar(i % 2), 1 + btScalar(i));
      join(bullet.add(shape, 1, place, btQuaternion(btVector3(1, 2, btScalar(i)).normalized(), btScalar(i))), 1, kRock);
    }
  }
  HalfRock halfRock;
};

TEST(ImpactEvents, AreTheSameWhoeverLooksOn) {
  Tumble alone, watched;
  watched.effect<Onlooker>();
  const ImpactEvents::Options all{.dustImpulse = BT_LARGE_FLOAT, .soundImpulse = 0};
  ImpactEvents *const mine = &alone.effect<ImpactEvents>(all), *const others = &watched.effect<ImpactEvents>(all);
  alone.step(1200, kStep);
  watched.step(1200, kStep);
  ASSERT_EQ(alone.bullet.stateHash(), watched.bullet.stateHash());
  std::vector<Event> told, expected;
  mine->events().takeInto(told);
  others->events().takeInto(expected);
  EXPECT_GT(told.size(), 20U);
  ASSERT_EQ(told.size(), expected.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].step, expected[i].step);
    EXPECT_EQ(told[i].bodyIds, expected[i].bodyIds);
    EXPECT_EQ(told[i].impulse, expected[i].impulse);
    EXPECT_EQ(told[i].closingSpeed, expected[i].closingSpeed);
    EXPECT_EQ(told[i].place, expected[i].place);
  }
}

TEST(ImpactEvents, AreOfOneWorldOfSeveralBehindADispatcher) {
  EffectWorld w;
  w.ground(kSoil);
  w.ball(btScalar(0.2), 1, btVector3(0, 0, btScalar(1.2)), btVector3(0, 0, 0));
  ImpactEvents& events =
      w.effect<ImpactEvents>(ImpactEvents::Options{.dustImpulse = BT_LARGE_FLOAT, .soundImpulse = 2});
  // The same places in its list, nobody whom the effects know.
  btDefaultCollisionConfiguration configuration;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld other(&w.bullet.dispatcher, &broadphase, &solver, &configuration);
  other.setGravity(btVector3(0, 0, -kGravity));
  btStaticPlaneShape plane(btVector3(0, 0, 1), btScalar(0));
  btSphereShape ball(btScalar(0.2));
  btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
  btRigidBody resting(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &ball, btVector3(1, 1, 1)));
  resting.getWorldTransform().setOrigin(btVector3(0, 0, btScalar(0.2)));
  other.addRigidBody(&ground);
  other.addRigidBody(&resting);
  for (int i = 0; i < 240; ++i) {
    other.stepSimulation(kStep, 1, kStep);
    w.step(1, kStep);
  }
  EXPECT_EQ(events.events().size(), 1U);
  other.removeRigidBody(&resting);
  other.removeRigidBody(&ground);
}

TEST(ImpactEvents, KeepsTheLastAndCountsWhatItDropped) {
  effects::BoundedLog<int> log(3);
  for (int i = 0; i < 5; ++i) log.add(i);
  std::vector<int> taken;
  log.takeInto(taken);
  EXPECT_EQ(taken, (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(log.dropped(), 2U);
  log.add(5);
  log.takeInto(taken);
  EXPECT_EQ(taken, (std::vector<int>{2, 3, 4, 5})) << "appended";
  effects::BoundedLog<int> none(0);
  none.add(1);
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.dropped(), 1U);
}

TEST(ImpactEvents, ChangesNothing) {
  Fall without, with;
  with.effect<ImpactEvents>(ImpactEvents::Options{.dustImpulse = 0, .soundImpulse = 0});
  for (int i = 0; i < 240; ++i) {
    without.step(1, kStep);
    with.step(1, kStep);
    ASSERT_EQ(without.bullet.stateHash(), with.bullet.stateHash());
  }
  EXPECT_GT(with.acted(), 0U);
}

// Bullet's solver goes by its speed, whatever else it is said to be.
TEST(ImpactEvents, TellsOfBlowsByWhatIsMovedByHand) {
  for (const int alsoStatic : {0, int(btCollisionObject::CF_STATIC_OBJECT)}) {
    EffectWorld w;
    ImpactEvents& events = w.effect<ImpactEvents>(ImpactEvents::Options{.dustImpulse = 0, .soundImpulse = 0});
    w.ball(btScalar(0.2), 1, btVector3(0, 0, 0), btVector3(0, 0, 0));
    btRigidBody& paddle =
        w.bullet.add(std::make_shared<btBoxShape>(btVector3(btScalar(0.5), 1, 1)), 0, btVector3(-1, 0, 0));
    constexpr btScalar kSpeed = 3;
    paddle.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT | alsoStatic);
    paddle.setActivationState(DISABLE_DEACTIVATION);
    w.set->describe(paddle, {.material = kRock});
    w.bullet.world.setGravity(btVector3(0, 0, 0));
    for (int i = 0; i < 60; ++i) {
      paddle.setWorldTransform(
          btTransform(btQuaternion::getIdentity(), btVector3(-1 + kSpeed * kStep * btScalar(i), 0, 0)));
      w.step(1, kStep);
    }
    std::vector<Event> told;
    events.events().takeInto(told);
    ASSERT_FALSE(told.empty()) << "flags " << alsoStatic;
    EXPECT_NEAR(told.front().closingSpeed, kSpeed, 1e-3) << "flags " << alsoStatic;
  }
}

}  // namespace
}  // namespace cairn::test::impact_events_test
