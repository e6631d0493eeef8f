// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"
#include "pile.h"

// 216 balls fall in a cube of six by six by six into a pit as wide.
//
//    |oooooo|
//    |oooooo|
//    |oooooo|
//    '------'
namespace cairn::hard {
namespace {

constexpr double kRadius = 0.25;

Figures fall(const test::TriedBody& ball, int side, double seconds) {
  test::StillWorld w;
  w.addGround();
  const double spacing = 2.05 * (kRadius + double(ball.margin)), half = side * spacing / 2;
  for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
    w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-half)), 0, btVector3(0, 0, 0));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < side * side * side; ++i) {
    // Every layer a little aside of the last, or they would stand on each other.
    const int layer = i / (side * side);
    const double aside = 0.02 * kRadius * (layer % 2 == 0 ? 1 : -1);
    const btVector3 place(btScalar((i % side + 0.5) * spacing - half + aside),
                          btScalar((i / side % side + 0.5) * spacing - half - aside),
                          btScalar((layer + 0.5) * 1.2 * spacing));
    bodies.push_back(&w.addTried(ball, btTransform(btQuaternion::getIdentity(), place), btScalar(0.5)));
  }
  double deepest = 0, peak = 0, kinetic = 0;
  for (int i = 0; i < int(seconds * test::kStepsPerSecond); ++i) {
    w.step();
    deepest = std::max(deepest, test::touching(w.dispatcher).penetration);
    kinetic = 0;
    for (const btRigidBody* body : bodies) kinetic += kineticEnergyOf(*body);
    peak = std::isfinite(kinetic) ? std::max(peak, kinetic) : kinetic;
  }
  return {100 * deepest / kRadius, kinetic / peak};
}

Outcome runBallPit(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const std::vector<Asked> asked{{"deepest penetration", 10, Bound::atMost, "% of the radius"},
                                 {"kinetic energy at the end", isWhole ? 1e-3 : 1e-2, Bound::atMost, "of its peak"}};
  return {
      compare(asked, balls(kRadius),
              [&](const CaseBody& body) { return fall(body.body, isWhole ? 6 : 3, isWhole ? 15 : 4); }),
      "At a blow: a step of 60 Hz takes a ball that fell a metre 30 % of its radius on. Why GImpact's balls are not as "
      "deep is not known."};
}

}  // namespace

HardCase ballPit() {
  return {"D11", "a pit of balls",
          "216 balls, 15 s at 60 Hz: never deeper than 10 % of the radius, kinetic energy down to a thousandth of its "
          "peak (proposed list)",
          runBallPit};
}

}  // namespace cairn::hard
