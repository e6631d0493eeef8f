// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "cairn/effects/gyroscopic.h"
#include "compare.h"
#include "dynamics_cases.h"
#include "slope_world.h"
#include "textbook.h"

// A wing nut: what spins about its middle axis turns over, again and again, and neither gains nor loses.
//
//       ___
//   ===|___|===  )   w about the middle axis
//         |
namespace cairn::hard {
namespace {

constexpr int kPerSecond = 240, kDriftSeconds = 10;

struct Tumble {
  double lost = 0, gained = 0;  // of the angular momentum's size, per cent
  double drift = 0;             // of the angular momentum in the world's frame, at most, in ten seconds, per cent
  double energyGained = 0;      // per cent
  double flips = 0;
};

Tumble tumble(const test::TriedBody& tried, bool byEffect, double spin, double seconds) {
  test::SlopeWorld w;
  if (byEffect) w.add<effects::Gyroscopic>(effects::Gyroscopic::Options{});
  w.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& body = w.addBody(tried.shape, 1, btVector3(0, 0, 5));
  body.setGravity(btVector3(0, 0, 0));
  body.setDamping(0, 0);
  body.setMassProps(1, tried.inertia);
  body.updateInertiaTensor();
  body.setAngularVelocity(btVector3(btScalar(0.01), btScalar(spin), btScalar(0.01)));
  const auto inAxes = [&] { return body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity(); };
  const auto inWorld = [&] { return body.getWorldTransform().getBasis() * (inAxes() * tried.inertia); };
  const auto momentum = [&] { return double((inAxes() * tried.inertia).length()); };
  const auto energy = [&] { return double((inAxes() * tried.inertia).dot(inAxes())); };
  const btVector3 inWorldBefore = inWorld();
  const double before = momentum(), energyBefore = energy();
  Tumble result;
  bool isOver = false;
  for (int i = 0; i < int(seconds * kPerSecond); ++i) {
    w.runStep();
    if (i < kDriftSeconds * kPerSecond)
      result.drift = std::max(result.drift, 100 * double((inWorld() - inWorldBefore).length()) / before);
    result.gained = std::max(result.gained, 100 * (momentum() / before - 1));
    result.energyGained = std::max(result.energyGained, 100 * (energy() / energyBefore - 1));
    // Its own axis against the momentum's, with some play, so that no wobble counts.
    const double along = double(inAxes().y()) / spin;
    if (isOver ? along > 0.5 : along < -0.5) {
      isOver = !isOver;
      ++result.flips;
    }
  }
  result.lost = 100 * (1 - momentum() / before);
  return result;
}

Outcome runTumbling(Effort effort) {
  const double seconds = effort == Effort::whole ? 60 : 10;
  const CaseBodies& bodies = boxes({0.2, 0.5, 1});
  const std::vector<Asked> asked{{"angular momentum lost, 5 rad/s", 0.1, Bound::atMost, "%"},
                                 {"angular momentum gained", 0.1, Bound::atMost, "%"},
                                 {"energy gained", 0.1, Bound::atMost, "%"},
                                 {"flips", 1, Bound::atLeast, ""},
                                 {"angular momentum lost, 10 rad/s", 0.1, Bound::atMost, "%"},
                                 {"angular momentum's drift in 10 s, 5 rad/s", 6, Bound::atMost, "%"},
                                 {"angular momentum's drift in 10 s, 10 rad/s", 6, Bound::atMost, "%"}};
  return {compare(asked, bodies,
                  [&](const CaseBody& body) -> Figures {
                    // Stock is stock: with what Bullet does by itself.
                    const bool isOurs = body.name == "tree";
                    const Tumble slow = tumble(body.body, isOurs, 5, seconds),
                                 fast = tumble(body.body, isOurs, 10, seconds);
                    return {slow.lost,
                            std::max(slow.gained, fast.gained),
                            std::max(slow.energyGained, fast.energyGained),
                            slow.flips,
                            fast.lost,
                            slow.drift,
                            fast.drift};
                  }),
          "The size is tightened: 6 % was proposed for the momentum, with Bullet's own gyroscopic torque; the effect's "
          "keeps the size. Its direction is decided by how Bullet turns bodies, and drifts with the step."};
}

}  // namespace

HardCase tumbling() {
  return {"D8", "a wing nut in free flight",
          "a box spinning about its middle axis, 60 s at 240 Hz with the effect `gyroscopic`: neither momentum nor "
          "energy gained, at most 0.1 % of the momentum's size lost, and it turns over; in 10 s the momentum, a vector "
          "in the world's frame, drifts by at most 6 %",
          runTumbling};
}

}  // namespace cairn::hard
