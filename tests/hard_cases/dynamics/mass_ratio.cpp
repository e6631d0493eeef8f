// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "bodies.h"
#include "compare.h"
#include "dynamics_cases.h"

// Four light cubes carry a heavy one, 240 steps a second.
//
//    [####]  x 10, x 100, x 1000
//     [  ]
//     [  ]   1 kg each
//     [  ]
//     [  ]
//   ========
namespace cairn::hard {
namespace {

constexpr int kCubes = 5;
constexpr double kStep = 1.0 / 240;

// Deepest penetration in parts of the size, greatest speed in parts of sqrt(2 g H) with H the stack's height, by how
// much the top is lower at the end in parts of the size.
Figures load(const test::TriedBody& cube, double ratio, double seconds) {
  test::StillWorld w;
  w.addGround();
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < kCubes; ++i) {
    const btScalar height = btScalar(i) + btScalar(0.5) + cube.margin * btScalar(2 * i + 1);
    bodies.push_back(
        &w.addTried(cube, btTransform(btQuaternion::getIdentity(), btVector3(0, 0, height)), btScalar(0.5)));
  }
  bodies.back()->setMassProps(btScalar(ratio), cube.inertia * btScalar(ratio));
  bodies.back()->updateInertiaTensor();
  const double top = double(bodies.back()->getWorldTransform().getOrigin().z());
  double deepest = 0, fastest = 0;
  for (int i = 0; i < int(seconds / kStep); ++i) {
    w.world.stepSimulation(btScalar(kStep), 0);
    deepest = test::greatest(deepest, test::touching(w.dispatcher).penetration);
    for (const btRigidBody* body : bodies) {
      const double speed = double(body->getLinearVelocity().length());
      fastest = test::greatest(fastest, speed);
    }
  }
  const double lower = top - double(bodies.back()->getWorldTransform().getOrigin().z());
  return {100 * deepest / std::sqrt(3.0), fastest / std::sqrt(2 * kGravity * kCubes), 100 * lower / std::sqrt(3.0)};
}

Outcome runMassRatio(Effort effort) {
  const double seconds = effort == Effort::whole ? 10 : 2;
  const std::vector<Asked> asked{{"1 : 10, deepest penetration", 5, Bound::atMost, "% of size"},
                                 {"1 : 100, deepest penetration", 5, Bound::atMost, "% of size"},
                                 {"top lower, up to 1 : 100", 5, Bound::atMost, "% of size"},
                                 {"1 : 1000, greatest speed", 2, Bound::atMost, "of sqrt(2gH)"}};
  return {
      compare(asked, cubes(1),
              [&](const CaseBody& body) -> Figures {
                const Figures ten = load(body.body, 10, seconds), hundred = load(body.body, 100, seconds),
                              thousand = load(body.body, 1000, seconds);
                return {ten[0], hundred[0], test::greatest(ten[2], hundred[2]), thousand[1]};
              }),
      "The heavy cube falls on a corner of a light one and squeezes it out along the ground. Its speed is chance: 1.1 "
      "to 3.8 in runs that differ by a rounding."};
}

}  // namespace

HardCase massRatio() {
  return {"D4", "heavy on light",
          "five cubes, the top one 10, 100 and 1000 times as heavy, 10 s at 240 Hz: at most 5 % of the size deep up to "
          "1 : 100, where it may not fall; at 1 : 1000 it may, never faster than 2 sqrt(2gH) (proposed list)",
          runMassRatio};
}

}  // namespace cairn::hard
