// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "cairn/effects/air_drag.h"
#include "cairn/effects/forest_drag.h"
#include "cairn/effects/friction.h"
#include "cairn/effects/ground_drag.h"
#include "cairn/effects/ground_height.h"
#include "cairn/effects/restitution.h"
#include "cairn/effects/rolling_resistance.h"
#include "cairn/effects/single_trees.h"
#include "cairn/effects/tangential_restitution.h"
#include "slope_world.h"

namespace cairn::test {

/// A rock and a step for which a law must hold: what a rock-fall has from a stone to a building.
struct LawCase {
  btScalar massKg, stepsPerSecond;

  /// Of a ball of rock.
  btScalar radius() const { return std::cbrt(massKg / kDensity * btScalar(0.75) / SIMD_PI); }
  static constexpr btScalar kDensity = 2650;
};
inline constexpr std::array<btScalar, 3> kLawMasses{10, 1e3, 1e5}, kLawRates{60, 240, 1000};

/// Of one law and case.
struct LawResult {
  double exact, measured;
  double ratio() const { return measured / exact; }
};

namespace laws {

using effects::PairTable;

/// A ball of rock in a world; on the ground unless it is lifted.
struct BallWorld {
  explicit BallWorld(const LawCase& c, btScalar lift = 0)
      : world(0, c.stepsPerSecond),
        radius(c.radius()),
        ball(&world.addBody(std::make_shared<btSphereShape>(radius), c.massKg, btVector3(0, 0, radius + lift),
                            c.massKg / c.kDensity)) {}

  void throwIt(const btVector3& velocity) const { ball->setLinearVelocity(velocity); }
  btScalar speed() const { return ball->getLinearVelocity().x(); }
  double energy() const { return 0.5 * double(ball->getMass()) * double(ball->getLinearVelocity().length2()); }

  SlopeWorld world;
  btScalar radius;
  btRigidBody* ball;
};

/// Both lengths a tenth of the radius.
struct RollingWorld : BallWorld {
  explicit RollingWorld(const LawCase& c) : BallWorld(c) {
    const btScalar length = radius / 10;
    world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.8)));
    world.add<effects::RollingResistance>(PairTable<effects::RollingResistance::Lengths>({length, length}));
  }
};

/// Of a body that cannot turn. How Bullet's iterations share its weight among four corners is another matter.
inline LawResult friction(const LawCase& c) {
  constexpr btScalar kFriction = btScalar(0.4), kSpeed = 5;
  BallWorld w(c);
  w.world.add<effects::Friction>(PairTable<btScalar>(kFriction));
  w.ball->setAngularFactor(0);
  w.throwIt(btVector3(kSpeed, 0, 0));
  w.world.run(1);
  return {kFriction * kGravity, kSpeed - w.speed()};
}

inline LawResult rolling(const LawCase& c) {
  constexpr btScalar kSpeed = 4;
  RollingWorld w(c);
  w.throwIt(btVector3(kSpeed, 0, 0));
  w.ball->setAngularVelocity(btVector3(0, kSpeed / w.radius, 0));
  w.world.run(1);
  return {5.0 / 7 * kGravity / 10, kSpeed - w.speed()};
}

inline LawResult spinning(const LawCase& c) {
  RollingWorld w(c);
  // I w' = -m g r / 10 with I = 2/5 m r^2.
  const double slowing = kGravity / 10 / (0.4 * double(w.radius));
  w.ball->setAngularVelocity(btVector3(0, 0, btScalar(2 * slowing)));
  w.world.run(1);
  return {slowing, 2 * slowing - double(w.ball->getAngularVelocity().z())};
}

/// The velocities before and after its first bounce.
inline std::array<btVector3, 2> bounce(BallWorld& w) {
  btVector3 before = w.ball->getLinearVelocity();
  for (int step = 0; step < 5000 && w.ball->getLinearVelocity().z() <= 0; ++step) {
    before = w.ball->getLinearVelocity();
    w.world.runStep();
  }
  return {before, w.ball->getLinearVelocity()};
}

inline LawResult restitution(const LawCase& c) {
  constexpr btScalar kPart = btScalar(0.5);
  BallWorld w(c, 10);
  w.world.add<effects::Restitution>(PairTable<btScalar>(kPart), effects::restitution::Constant{});
  const auto [before, after] = bounce(w);
  return {double(-before.z() * kPart), after.z()};
}

inline LawResult tangentialRestitution(const LawCase& c) {
  constexpr btScalar kPart = btScalar(0.8), kSpeed = 6;
  BallWorld w(c, 10);
  w.world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  w.world.add<effects::Restitution>(PairTable<btScalar>(btScalar(0.5)), effects::restitution::Constant{});
  w.world.add<effects::TangentialRestitution>(PairTable<btScalar>(kPart));
  w.throwIt(btVector3(kSpeed, 0, 0));
  return {double(kPart * kSpeed), bounce(w)[1].x()};
}

/// v / (1 + k v t) with k = rho Cd pi r^2 / (2 m), in a gas so dense that a rock of any size loses half its speed.
inline LawResult airDrag(const LawCase& c) {
  constexpr double kSpeed = 30;
  BallWorld w(c, 1000);
  const double section = double(SIMD_PI * w.radius * w.radius), perMetre = 1 / kSpeed;
  const double density = perMetre * 2 * double(c.massKg) / (0.5 * section);
  w.world.add<effects::AirDrag>(effects::AirDrag::Options{btScalar(density), btScalar(0.5), 0});
  w.world.bullet.world.setGravity(btVector3(0, 0, 0));
  w.ball->setGravity(btVector3(0, 0, 0));
  w.throwIt(btVector3(btScalar(kSpeed), 0, 0));
  w.world.run(1);
  return {kSpeed - kSpeed / (1 + perMetre * kSpeed), kSpeed - double(w.speed())};
}

/// v exp(-c t / m), which halves the speed of any mass in a second.
inline LawResult forestDrag(const LawCase& c) {
  static const effects::LevelGround level(0);
  constexpr double kSpeed = 10;
  BallWorld w(c);
  w.world.add<effects::ForestDrag>(
      effects::ForestDrag::Options{.height = 10, .coefficient = c.massKg * btScalar(std::log(2.0))}, level);
  w.world.add<effects::Friction>(PairTable<btScalar>());
  w.throwIt(btVector3(btScalar(kSpeed), 0, 0));
  w.world.run(1);
  return {kSpeed / 2, kSpeed - double(w.speed())};
}

inline LawResult groundDrag(const LawCase& c) {
  static const effects::LevelGround level(0);
  constexpr double kSpeed = 4, kDeceleration = 2;
  BallWorld w(c);
  w.world.add<effects::GroundDrag>(
      effects::GroundDrag::Options{.below = 5, .within = 1, .deceleration = btScalar(kDeceleration)}, level);
  w.world.add<effects::Friction>(PairTable<btScalar>());
  w.throwIt(btVector3(btScalar(kSpeed), 0, 0));
  w.world.run(1);
  return {kDeceleration, kSpeed - double(w.speed())};
}

/// A stem that takes 38.7 D^2.31 J (D in cm) times a ratio, here a third of the energy of any rock, and of that the
/// share of a hit in its middle.
inline LawResult stem(const LawCase& c) {
  static const effects::LevelGround level(0);
  constexpr btScalar kSpeed = 10, kDiameter = btScalar(0.3);
  BallWorld w(c);
  w.throwIt(btVector3(kSpeed, 0, 0));
  const double before = w.energy(), taken = before / 3, ofLaw = 38.7 * std::pow(100 * double(kDiameter), 2.31);
  w.world.add<effects::SingleTrees>(
      std::vector<effects::SingleTrees::Stem>{{w.radius + 3, 0, kDiameter}}, level,
      effects::SingleTrees::Options{.height = 100, .energyRatio = btScalar(taken / ofLaw)});
  w.world.add<effects::Friction>(PairTable<btScalar>());
  w.world.run(btScalar(0.7));
  const double share = -0.046 + (0.98 + 0.046) / (1 + std::pow(10, 0.58 * -8.007));
  return {share * taken, before - w.energy()};
}

}  // namespace laws

/// A law of rock-fall, by name.
struct Law {
  std::string_view name, quantity;
  LawResult (*measure)(const LawCase&);
};
inline std::vector<Law> everyLaw() {
  return {{"friction", "mu g", laws::friction},
          {"rolling resistance", "5/7 c g / r", laws::rolling},
          {"spinning resistance", "c g m / I", laws::spinning},
          {"restitution", "e v", laws::restitution},
          {"tangential restitution", "Rt v", laws::tangentialRestitution},
          {"air drag", "v - v / (1 + k v t)", laws::airDrag},
          {"forest drag", "v - v exp(-c t / m)", laws::forestDrag},
          {"ground drag", "a", laws::groundDrag},
          {"single stem", "38 D^2.31 J", laws::stem}};
}

}  // namespace cairn::test
