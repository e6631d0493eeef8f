// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "bodies.h"
#include "compare.h"
#include "dynamics_cases.h"
#include "pile.h"
#include "scenes/bodies/model.h"
#include "scenes/figures/random.h"
#include "triangle_grounds.h"

// Rods of a hundred times their width, thrown tumbling onto a flat mesh.
//
//      \      /
//       \    / ----
//        \  /
//   __/\__/\__/\__/\__   triangles of a metre
namespace cairn::hard {
namespace {

constexpr double kThick = 0.04, kLong = 4;

// Through: below the mesh by more than it is thick. Rise: of a rod's energy over what it had, per cent of that.
Figures dropRods(const test::TriedBody& rod, int count, double seconds, double perSecond) {
  const auto ground = test::flatGround(test::TriangleGround::mesh);
  double through = 0, rise = 0;
  for (int i = 0; i < count; ++i) {
    scenes::Random random(7, std::uint64_t(i));
    test::StillWorld w;
    w.add(ground, 0, btVector3(0, 0, 0));
    const btTransform at(random.rotation(), btVector3(0, 0, btScalar(random.uniform(2.1, 3))));
    btRigidBody& body = w.addTried(rod, at, btScalar(0.5));
    body.setAngularVelocity(scenes::toBullet(random.direction() * random.uniform(0, 5)));
    const auto energy = [&] {
      return kineticEnergyOf(body) + kGravity * double(body.getWorldTransform().getOrigin().z());
    };
    const double start = energy();
    double least = start;
    for (int step = 0; step < int(seconds * perSecond); ++step) {
      w.world.stepSimulation(btScalar(1 / perSecond), 0);
      const double now = energy();
      least = std::min(least, now);
      rise = std::isfinite(now) ? std::max(rise, (now - least) / start) : now;
    }
    through += body.getWorldTransform().getOrigin().z() > btScalar(-kThick) ? 0 : 1;
  }
  return {through, 100 * rise};
}

Outcome runThinRods(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const int count = isWhole ? 100 : 6;
  const std::vector<Asked> asked{{"through", 0, Bound::atMost, "of " + std::to_string(count)},
                                 {"energy gained after any loss", 1, Bound::atMost, "%"}};
  return {compare(asked, boxes({kLong, kThick, kThick}),
                  [&](const CaseBody& body) { return dropRods(body.body, count, isWhole ? 6 : 3, 240); }),
          ""};
}

}  // namespace

HardCase thinRods() {
  return {"D7", "thin rods on a mesh",
          "100 rods of 4 m by 0.04, dropped tumbling at 240 Hz: none through, energy never rises by more than 1 % "
          "(proposed list)",
          runThinRods};
}

}  // namespace cairn::hard
