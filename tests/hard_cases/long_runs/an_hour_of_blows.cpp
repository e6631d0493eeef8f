// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "../dynamics/compare.h"
#include "../dynamics/pile.h"
#include "long_run_cases.h"
#include "scenes/bodies/model.h"
#include "scenes/figures/random.h"

// A heap that is knocked about for an hour, one body every second.
//
//    | o O\\ |
//    |oOoOoO| <- !    0 h ........ 1 h
//    '------'
namespace cairn::hard {
namespace {

/// Resident memory of the process, KiB; no number where the system does not tell.
double residentKib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6));
  return NAN;
}

struct Hour {
  int insane = 0, lost = 0;
  double energy = 0;      // greatest after a blow's second, J/kg
  double memory = 0;      // KiB grown since the first tenth
  double operations = 0;  // mean of the last tenth over that of the first, less 1, per cent
};

constexpr double kBlow = 2;  // m/s, and of a kilogram also what it brings in J
constexpr int kBodies = 12;
constexpr std::uint64_t kHeaps = 5;

Figures knockAbout(const test::TriedBody& rock, int seconds, std::uint64_t seed) {
  Pile pile(rock, 1, {.bodies = kBodies, .seed = seed, .doSleep = true});
  scenes::Random random(10 + seed);
  for (int i = 0; i < 5 * test::kStepsPerSecond; ++i) pile.step();
  Hour hour;
  double first = 0, last = 0, memory = 0;
  const int tenth = std::max(1, seconds / 10);
  for (int second = 0; second < seconds; ++second) {
    btRigidBody& body = *pile.bodies()[std::size_t(random.uniform(0, kBodies))];
    body.activate(true);
    body.applyCentralImpulse(scenes::toBullet(random.direction() * kBlow));
    for (int i = 0; i < test::kStepsPerSecond; ++i) {
      pile.step();
      const double operations = double(pile.world().dispatcher.lastStep().operations);
      (second < tenth ? first : second >= seconds - tenth ? last : hour.operations) += operations;
    }
    hour.energy = test::greatest(hour.energy, pile.kineticEnergy() / kBodies);
    if (second == tenth) memory = residentKib();
  }
  hour.operations = first > 0 && last > 0 ? 100 * (last / first - 1) : NAN;
  hour.memory = residentKib() - memory;
  hour.insane = pile.countInsane();
  hour.lost = pile.countLost();
  return {double(hour.insane), double(hour.lost), hour.energy, hour.memory, hour.operations};
}

Outcome runAnHourOfBlows(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const std::vector<Asked> asked{
      {"bodies that are not finite, most", 0, Bound::atMost, "", 1},
      {"bodies lost, most", 0, Bound::atMost, "", 1},
      {"kinetic energy a second after a blow, most", kBlow / kBodies, Bound::atMost, "J/kg", 1},
      {"memory grown, most", 1024, Bound::atMost, "KiB", 1},
      {"narrow phase, last tenth over first, more, median", isWhole ? 10.0 : 50.0, Bound::atMost, "% operations"}};
  std::vector<Figures> heaps;
  for (std::uint64_t seed = 1; seed <= (isWhole ? kHeaps : 1); ++seed)
    heaps.push_back(knockAbout(rocks(seed, 1).front().body, isWhole ? 3600 : 20, seed));
  return {besideTheBest(asked, joined(asked, heaps), {}), ""};
}

}  // namespace

HardCase anHourOfBlows() {
  return {
      "L2", "an hour of blows",
      "five heaps of 12 rocks, one of each struck by 2 N s every second for an hour: no NaN, nobody lost, no more "
      "energy than the blow's 2 J among all, no more than 1 MiB of memory more, the narrow phase's work at the end as "
      "at first (in the median)",
      runAnHourOfBlows};
}

}  // namespace cairn::hard
