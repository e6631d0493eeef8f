// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "../dynamics/compare.h"
#include "../dynamics/pile.h"
#include "long_run_cases.h"

// A heap left alone for ten minutes, nobody ever asleep.
//
//    | o O  |
//    |oOoOoO|   00:00 ........ 10:00
//    '------'
namespace cairn::hard {
namespace {

Figures leaveAlone(const test::TriedBody& rock, double seconds) {
  constexpr double kSettling = 20;
  Pile pile(rock, 1, {.bodies = 12});
  for (int i = 0; i < int(kSettling * test::kStepsPerSecond); ++i) pile.step();
  std::vector<btVector3> places;
  for (const btRigidBody* body : pile.bodies()) places.push_back(body->getWorldTransform().getOrigin());
  const double start = pile.energy();
  double rise = 0;
  for (int i = 0; i < int(seconds * test::kStepsPerSecond); ++i) {
    pile.step();
    rise = std::max(rise, 100 * (pile.energy() / start - 1));
  }
  std::vector<double> ways;
  for (std::size_t i = 0; i < places.size(); ++i)
    ways.push_back(100 * double((pile.bodies()[i]->getWorldTransform().getOrigin() - places[i]).length()));
  std::ranges::sort(ways);
  return {ways[ways.size() / 2], rise, 1000 * pile.kineticEnergy() / double(places.size()), double(pile.countLost())};
}

Outcome runTenMinutesAtRest(Effort effort) {
  const double seconds = effort == Effort::whole ? 600 : 5;
  const std::vector<Asked> asked{{"drift, median", 100 * 1e-3 * seconds / 60, Bound::atMost, "% of size"},
                                 {"energy gained", 1, Bound::atMost, "%"},
                                 {"kinetic energy at the end", 1, Bound::atMost, "mJ/kg"},
                                 {"lost", 0, Bound::atMost, ""}};
  return {compare(asked, rocks(1, 1), [&](const CaseBody& body) { return leaveAlone(body.body, seconds); }),
          "Bullet's friction gives way a little in every step: heaps creep in every shape."};
}

}  // namespace

HardCase tenMinutesAtRest() {
  return {"L1", "ten minutes at rest",
          "a heap of 12 rocks, 600 s without sleep: drift at the pace D1 allows, 1e-3 of the size a minute, no more "
          "than 1 % of its energy gained, 1 mJ/kg moving at the end, the status of heaps that lie",
          runTenMinutesAtRest};
}

}  // namespace cairn::hard
