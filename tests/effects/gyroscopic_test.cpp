// SPDX-License-Identifier: Zlib
// A body that spins about its middle axis in empty space turns over again and again, and keeps its energy and its
// angular momentum (Poinsot; seen by Dzhanibekov).
#include "cairn/effects/gyroscopic.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "effect_world.h"

namespace cairn::test::gyroscopic_test {
namespace {

using effects::Gyroscopic;

constexpr btScalar kSpin = 5;  // rad/s

enum class By { effect, bulletsDefault, nobody };

/// A weightless wing nut that spins about its middle axis and is a hundredth off it.
struct Spinning : EffectWorld {
  explicit Spinning(By by) {
    bullet.world.setGravity(btVector3(0, 0, 0));
    if (by == By::effect) effect<Gyroscopic>(Gyroscopic::Options{});
    if (by == By::nobody) body.setFlags(0);
    join(body, 1);
    body.setAngularVelocity(btVector3(kSpin / 100, kSpin, 0));
  }
  btVector3 spinInAxes() const { return body.getAngularVelocity() * body.getCenterOfMassTransform().getBasis(); }
  btVector3 momentum() const {
    const btVector3 w = spinInAxes(), inverse = body.getInvInertiaDiagLocal();
    return body.getCenterOfMassTransform().getBasis() *
           btVector3(w.x() / inverse.x(), w.y() / inverse.y(), w.z() / inverse.z());
  }

  btRigidBody& body = bullet.add(std::make_shared<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.3), btScalar(0.1))),
                                 10, btVector3(0, 0, 0));
};

struct Kept {
  double leastMomentum = 1, mostEnergy = 1, leastEnergy = 1;  // of those at the start
  double turned = 0;                                          // of the momentum's direction at the end, radians
  int flips = 0;
};

Kept spin(By by, int perSecond, int seconds) {
  Spinning w(by);
  Kept kept;
  const btVector3 momentum = w.momentum();
  const double energy = double(kineticEnergy(w.body));
  bool isUp = true;
  for (int i = 0; i < perSecond * seconds; ++i) {
    w.step(1, btScalar(1) / btScalar(perSecond));
    kept.leastMomentum = std::min(kept.leastMomentum, double(w.momentum().length() / momentum.length()));
    kept.mostEnergy = std::max(kept.mostEnergy, double(kineticEnergy(w.body)) / energy);
    kept.leastEnergy = std::min(kept.leastEnergy, double(kineticEnergy(w.body)) / energy);
    // Past the middle, and not just about it.
    if (const btScalar middle = w.spinInAxes().y(); std::abs(middle) > kSpin / 2 && (middle > 0) != isUp) {
      isUp = !isUp;
      ++kept.flips;
    }
  }
  kept.turned = double(w.momentum().angle(momentum));
  return kept;
}

// Each step rounds the spin and the axes it is seen in.
double roundings(int steps) {
  return 4 * std::sqrt(double(steps)) * double(SIMD_EPSILON);
}

TEST(Gyroscopic, AWingNutTurnsOverAndLosesNothing) {
  const Kept ours = spin(By::effect, 240, 10), bullets = spin(By::bulletsDefault, 240, 10);
  EXPECT_GE(ours.flips, 1);
  EXPECT_LT(1 - ours.leastMomentum, 1e-3);
  EXPECT_LT(1 - ours.leastEnergy, 1e-3);
  EXPECT_LT(ours.mostEnergy - 1, roundings(2400));
  EXPECT_GT(1 - bullets.leastMomentum, 0.01) << "what it is for";
  EXPECT_EQ(spin(By::nobody, 240, 10).flips, 0) << "what it is for";
}

TEST(Gyroscopic, NorInAMinuteOfLongSteps) {
  const Kept ours = spin(By::effect, 60, 60), bullets = spin(By::bulletsDefault, 60, 60);
  std::cout << "60 s at 60 Hz: of |L| are left " << ours.leastMomentum << ", with Bullet's default "
            << bullets.leastMomentum << "; flips " << ours.flips << " and " << bullets.flips << "; L turned by "
            << ours.turned << " and " << bullets.turned << " rad; energy at most " << ours.mostEnergy << " and least "
            << ours.leastEnergy << ", Bullet " << bullets.leastEnergy << '\n';
  EXPECT_GE(ours.flips, 5);
  EXPECT_LT(1 - ours.leastMomentum, 1e-3);
  EXPECT_LT(1 - ours.leastEnergy, 1e-3);
  EXPECT_LT(ours.mostEnergy - 1, roundings(3600));
  EXPECT_GT(1 - bullets.leastMomentum, 0.1);
}

TEST(Gyroscopic, AStepKeepsEnergyAndMomentum) {
  for (const btScalar speed : {btScalar(0.1), btScalar(5), btScalar(40)})
    for (const btVector3& direction : {btVector3(1, 2, 3), btVector3(-1, 1, 0), btVector3(0, 5, btScalar(0.1))}) {
      const btVector3 moments(1, btScalar(2.5), 3), before = direction.normalized() * speed;
      const btVector3 after = Gyroscopic::spinAfter(moments, before, btScalar(1) / 60);
      const btScalar energy = (moments * before).dot(before), square = (moments * before).length2();
      // Rounded are three components of the answer, and the sums here.
      constexpr btScalar kRounding = 8 * SIMD_EPSILON;
      EXPECT_NEAR((moments * after).dot(after) / energy, 1, kRounding);
      EXPECT_NEAR((moments * after).length2() / square, 1, kRounding);
      EXPECT_GT((after - before).length(), 1e-5 * speed) << "it did turn";
    }
}

TEST(Gyroscopic, TakesUnevenBodiesAndGivesThemBack) {
  EffectWorld w;
  btRigidBody& ball = w.ball(1, 1, btVector3(0, 0, 0), btVector3(0, 0, 0));
  btRigidBody& plate =
      w.bullet.add(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.1))), 1, btVector3(5, 0, 0));
  w.join(plate, 1);
  const int ballsFlags = ball.getFlags(), platesFlags = plate.getFlags();
  ASSERT_NE(platesFlags & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY, 0);
  w.effect<Gyroscopic>(Gyroscopic::Options{});
  EXPECT_EQ(ball.getFlags(), ballsFlags);
  EXPECT_EQ(plate.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY, 0);
  ball.setAngularVelocity(btVector3(1, 2, 3));
  w.step(1, btScalar(1) / 60);
  EXPECT_EQ(w.acted(), 0U) << "one is even, the other does not spin";
  w.set->removeBody(plate);
  EXPECT_EQ(plate.getFlags(), platesFlags);
}

}  // namespace
}  // namespace cairn::test::gyroscopic_test
