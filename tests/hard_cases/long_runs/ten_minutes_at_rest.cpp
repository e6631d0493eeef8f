// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <string>

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

Figures leaveAlone(const test::TriedBody& rock, double seconds, std::uint64_t seed, bool inTwoDirections) {
  constexpr double kSettling = 20;
  Pile pile(rock, 1, {.bodies = 12, .seed = seed, .inTwoDirections = inTwoDirections});
  for (int i = 0; i < int(kSettling * test::kStepsPerSecond); ++i) pile.step();
  std::vector<btVector3> places;
  for (const btRigidBody* body : pile.bodies()) places.push_back(body->getWorldTransform().getOrigin());
  double least = pile.energy(), rise = 0;
  for (int i = 0; i < int(seconds * test::kStepsPerSecond); ++i) {
    pile.step();
    const double energy = pile.energy();
    rise = test::greatest(rise, 100 * (energy / least - 1));
    least = -test::greatest(-least, -energy);
  }
  std::vector<double> ways;
  for (std::size_t i = 0; i < places.size(); ++i)
    ways.push_back(100 * double((pile.bodies()[i]->getWorldTransform().getOrigin() - places[i]).length()));
  return {quantileOf(ways, 0.5, Bound::atMost), rise, 1000 * pile.kineticEnergy() / double(places.size()),
          double(pile.countLost())};
}

Outcome runTenMinutesAtRest(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const double seconds = isWhole ? 600 : 5, drift = 100 * 1e-3 * seconds / 60;
  std::vector<Asked> asked;
  for (const std::string friction : {"", ", friction in two directions"}) {
    asked.push_back({"drift, median" + friction, drift, Bound::atMost, "% of size"});
    asked.push_back({"energy gained after any loss, most" + friction, 1, Bound::atMost, "%", 1});
    asked.push_back({"kinetic energy at the end, most" + friction, 1, Bound::atMost, "mJ/kg", 1});
    asked.push_back({"lost, most" + friction, 0, Bound::atMost, "", 1});
  }
  const auto rock = [](std::uint64_t seed) -> const CaseBodies& { return rocks(seed, 1); };
  const auto run = [&](const CaseBody& body, std::uint64_t seed) {
    Figures figures = leaveAlone(body.body, seconds, seed, false);
    std::ranges::copy(leaveAlone(body.body, seconds, seed, true), std::back_inserter(figures));
    return figures;
  };
  return {
      compareSeeds(asked, isWhole ? 9 : 5, rock, run),
      "Bullet's friction begins at nothing in every step, and ten rounds do not end it: heaps creep in every shape, "
      "in two directions as in one."};
}

}  // namespace

HardCase tenMinutesAtRest() {
  return {"L1", "ten minutes at rest",
          "nine heaps of 12 rocks, their median drift and the worst of all else, 600 s without sleep: drift at the "
          "pace D1 allows, 1e-3 of the size a minute, never 1 % more energy than the least before, 1 mJ/kg moving at "
          "the end, the status of heaps that lie",
          runTenMinutesAtRest};
}

}  // namespace cairn::hard
