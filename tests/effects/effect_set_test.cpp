// SPDX-License-Identifier: Zlib
// A set of effects changes nothing in a world until an effect is added.
#include "cairn/effects/effect_set.h"

#include <gtest/gtest.h>

#include <vector>

#include "bullet_world.h"
#include "cairn/effects/friction.h"
#include "cairn/effects/restitution.h"
#include "cairn/effects/surface_roughness.h"
#include "slope_world.h"

namespace cairn::test::effect_set_test {
namespace {

using effects::EffectSet;

/// A ball of a sphere-tree and a box fall onto a ground that leans.
struct Scene {
  BulletWorld<> bullet;
  btRigidBody& ground =
      bullet.add(std::make_shared<btStaticPlaneShape>(btVector3(btScalar(-0.3), 0, 1).normalized(), btScalar(0)), 0,
                 btVector3(0, 0, 0));
  btRigidBody& box = bullet.add(std::make_shared<btBoxShape>(btVector3(btScalar(.5), btScalar(.4), btScalar(.3))), 2,
                                btVector3(0, 0, 2));
  btRigidBody& ball = bullet.add(std::make_shared<btSphereShape>(btScalar(.4)), 1, btVector3(0, 0, 3));

  std::string runAndHash(int steps) {
    StateHash hash;
    for (int i = 0; i < steps; ++i) {
      bullet.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
      addState(hash, box);
      addState(hash, ball);
    }
    return hash.hex();
  }
  void join(EffectSet& set) {
    set.addBody(box, {.material = kRock, .volume = btScalar(0.48)});
    set.addBody(ball, {.material = kRock, .volume = btScalar(0.268)});
    set.describe(ground, {.material = kSoil});
  }
};

std::unique_ptr<EffectSet> effectsOf(Scene& scene) {
  auto set = EffectSet::create(scene.bullet.world);
  EXPECT_TRUE(set) << (set ? "" : set.error().message);
  scene.join(*set.value());
  return std::move(set).value();
}

TEST(EffectSet, WithoutEffectsChangesNoBit) {
  Scene plain, with;
  const auto set = effectsOf(with);
  EXPECT_EQ(plain.runAndHash(240), with.runAndHash(240));
}

TEST(EffectSet, GivesTheSolverBack) {
  Scene scene;
  btConstraintSolver* solver = scene.bullet.world.getConstraintSolver();
  {
    const auto set = effectsOf(scene);
    EXPECT_NE(scene.bullet.world.getConstraintSolver(), solver);
  }
  EXPECT_EQ(scene.bullet.world.getConstraintSolver(), solver);
}

TEST(EffectSet, RefusesAWorldThatOwnsItsSolver) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, nullptr, &configuration);
  const auto set = EffectSet::create(world);
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().message.find("solver"), std::string::npos);
}

/// Notes what it is told.
class Witness final : public effects::Effect,
                      effects::ForceHook,
                      effects::MaterialHook,
                      effects::ImpactHook,
                      effects::EventHook {
 public:
  std::string_view name() const override { return "witness"; }
  effects::Hooks hooks() override { return {this, this, this, this}; }
  void welcome(effects::Body& body) override { welcomed.push_back(body.id); }
  void dismiss(effects::Body& body) override { dismissed.push_back(body.id); }

  std::vector<std::uint32_t> welcomed, dismissed;
  std::vector<std::string> calls;
  std::vector<effects::Impact> impacts;
  std::size_t mostBodies = 0, mostContacts = 0;

 private:
  std::uint32_t applyForces(std::span<effects::Body* const> bodies, const effects::Step&) override {
    calls.push_back("force");
    mostBodies = std::max(mostBodies, bodies.size());
    return static_cast<std::uint32_t>(bodies.size());
  }
  std::uint32_t changeContacts(std::span<effects::Contact> contacts, const effects::Step&) override {
    calls.push_back("contacts");
    mostContacts = std::max(mostContacts, contacts.size());
    return 0;
  }
  std::uint32_t afterImpacts(std::span<const effects::Impact> now, const effects::Step&) override {
    calls.push_back("impacts");
    impacts.insert(impacts.end(), now.begin(), now.end());
    return static_cast<std::uint32_t>(now.size());
  }
  std::uint32_t noteImpacts(std::span<const effects::Impact>, const effects::Step&) override {
    calls.push_back("events");
    return 0;
  }
};

TEST(EffectSet, AsksHooksInOrderInEveryInternalStep) {
  Scene scene;
  const auto set = effectsOf(scene);
  auto owned = std::make_unique<Witness>();
  const Witness& witness = *owned;
  set->add(std::move(owned));
  scene.bullet.world.stepSimulation(btScalar(2) / 120, 4, btScalar(1) / 120);
  const std::vector<std::string> once{"force", "contacts", "impacts", "events"};
  std::vector<std::string> twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(witness.calls, twice);
  EXPECT_EQ(witness.mostBodies, 2U);
}

TEST(EffectSet, BodiesAreWelcomedAndDismissedOnce) {
  Scene scene;
  const auto set = effectsOf(scene);
  auto owned = std::make_unique<Witness>();
  const Witness& witness = *owned;
  set->add(std::move(owned));
  EXPECT_EQ(witness.welcomed, (std::vector<std::uint32_t>{0, 1}));
  set->removeBody(scene.box);
  set->removeBody(scene.box);
  EXPECT_EQ(witness.dismissed, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(set->addBody(scene.box, {}), 2U) << "numbers are not given twice";
}

/// A ball falls from a height onto level ground and bounces: one blow, whose figures are those of the fall.
TEST(EffectSet, AnImpactIsWhatTheFallSays) {
  BulletWorld<> bullet;
  btRigidBody& ground =
      bullet.add(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), 0, btVector3(0, 0, 0));
  constexpr btScalar kMass = 3, kRadius = btScalar(0.5), kHeight = 5;
  btRigidBody& ball = bullet.add(std::make_shared<btSphereShape>(kRadius), kMass, btVector3(1, 2, kRadius + kHeight));
  auto created = EffectSet::create(bullet.world);
  ASSERT_TRUE(created);
  EffectSet& set = *created.value();
  set.addBody(ball, {.material = kRock});
  set.describe(ground, {.material = kSoil});
  // Bullet pushes what does not bounce out of the ground besides stopping it.
  constexpr btScalar kRestitution = btScalar(0.5);
  set.add(std::make_unique<effects::Restitution>(effects::PairTable<btScalar>(kRestitution),
                                                 effects::restitution::Constant{}));
  auto owned = std::make_unique<Witness>();
  const Witness& witness = *owned;
  set.add(std::move(owned));
  constexpr btScalar kStep = btScalar(1) / 240;
  for (int i = 0; i < 300; ++i) bullet.world.stepSimulation(kStep, 1, kStep);
  ASSERT_EQ(witness.impacts.size(), 1U);
  const effects::Impact& impact = witness.impacts.front();
  const btScalar speed = btSqrt(2 * btScalar(9.81) * kHeight);
  // The step in which it lands begins and ends up to one step's fall early or late, and gravity acts in between.
  const btScalar tolerance = 2 * btScalar(9.81) * kStep;
  EXPECT_NEAR(impact.closingSpeed, speed, tolerance);
  EXPECT_NEAR(impact.impulse, kMass * (1 + kRestitution) * speed, kMass * 2 * tolerance);
  EXPECT_NEAR(impact.energy(), kMass * speed * speed / 2, kMass * speed * tolerance);
  const std::size_t moving = impact.sides[0].body != nullptr ? 0 : 1;
  EXPECT_EQ(impact.sides[moving].object, &ball);
  EXPECT_EQ(impact.sides[moving].material, kRock);
  EXPECT_EQ(impact.sides[1 - moving].object, &ground);
  EXPECT_EQ(impact.sides[1 - moving].material, kSoil);
  EXPECT_NEAR(impact.place.x(), 1, 1e-4);
  EXPECT_NEAR(impact.linearBefore[moving].z(), -speed, tolerance);
}

/// A pair that separates elsewhere during a blow does not change the blow.
TEST(EffectSet, ABlowGoesOnWhenOthersLeave) {
  const auto blow = [](int leaves) {
    SlopeWorld world(0, 120);
    const Witness& witness = world.add<Witness>();
    // No restitution: Bullet takes two steps to stop it.
    world.addBody(std::make_shared<btSphereShape>(btScalar(0.5)), 3, btVector3(0, 0, 3));
    btRigidBody& other = world.addBody(std::make_shared<btSphereShape>(btScalar(0.5)), 3, btVector3(100, 0, 50));
    for (int step = 0; step < 120; ++step) {
      world.runStep();
      if (step == leaves) world.set().removeBody(other);
    }
    EXPECT_EQ(witness.impacts.size(), 1U) << "left after step " << leaves;
    return witness.impacts.empty() ? btScalar(0) : witness.impacts.front().closingSpeed;
  };
  const btScalar undisturbed = blow(-1);
  for (int leaves = 70; leaves < 95; ++leaves) EXPECT_EQ(blow(leaves), undisturbed) << leaves;
}

TEST(EffectSet, BodiesAsleepAndStrangersAreLeftOut) {
  Scene scene;
  auto created = EffectSet::create(scene.bullet.world);
  ASSERT_TRUE(created);
  EffectSet& set = *created.value();
  set.addBody(scene.box, {.material = kRock});  // neither the ball nor the ground
  auto owned = std::make_unique<Witness>();
  const Witness& witness = *owned;
  set.add(std::move(owned));
  scene.runAndHash(240);
  EXPECT_EQ(witness.mostBodies, 1U);
  EXPECT_EQ(witness.mostContacts, 0U) << "contacts with what nobody described";
}

TEST(EffectSet, ReportsWhatActed) {
  Scene scene;
  const auto set = effectsOf(scene);
  set->add(std::make_unique<effects::Friction>(effects::PairTable<btScalar>(btScalar(0.4))));
  set->add(std::make_unique<effects::SurfaceRoughness>(std::vector<btScalar>{0, 0}, 1));
  scene.runAndHash(240);
  const std::vector<effects::EffectReport> report = set->report();
  ASSERT_EQ(report.size(), 2U);
  EXPECT_EQ(report[0].name, "friction");
  EXPECT_GT(report[0].acted, report[0].stepsActed) << "several contacts in a step";
  EXPECT_GT(report[0].elapsedMicroseconds, 0);
  EXPECT_EQ(report[1].acted, 0U) << "smooth materials";
}

}  // namespace
}  // namespace cairn::test::effect_set_test
