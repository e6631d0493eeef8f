// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <string>

#include "compare.h"
#include "dynamics_cases.h"
#include "lying.h"

// A rock let down on a plane, never put to sleep: once it lies, it lies.
//
//        .-'''-.
//       /       '.       drift: from the first place to the last
//      |    +     )      RMS: about the mean place
//   ====`=-------'====
namespace cairn::hard {
namespace {

Outcome runRestForAMinute(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const double seconds = isWhole ? 60 : 4, part = seconds / 60;  // what creeps does so at an even pace
  std::vector<Asked> asked;
  for (const std::string friction : {"", ", friction along a fixed direction", ", friction in two directions"}) {
    asked.push_back({"place, RMS about its mean" + friction, 0.01 * part, Bound::atMost, "% of size"});
    asked.push_back({"drift" + friction, 0.1 * part, Bound::atMost, "% of size"});
    asked.push_back({"drift, upper tenth" + friction, 0.1 * part, Bound::atMost, "% of size", 0.9});
  }
  const auto rock = [](std::uint64_t seed) -> const CaseBodies& { return rocks(seed, 1); };
  const auto run = [&](const CaseBody& body, std::uint64_t) {
    LyingStart start{.size = 1, .seconds = seconds, .settling = isWhole ? 15.0 : 5.0};
    Figures figures;
    for (const test::Resisted resisted : {test::Resisted::sliding, test::Resisted::fixed, test::Resisted::both}) {
      start.resisted = resisted;
      std::ranges::copy(lie(body.body, start), std::back_inserter(figures));
      figures.push_back(figures.back());  // the drift again, for its upper tenth
    }
    return figures;
  };
  return {
      compareSeeds(asked, isWhole ? 40 : 20, rock, run),
      "Bullet's solver resists along one direction, that of the sliding as the step begins. A rock that rocks slides "
      "another way within the step and creeps on. Hulls creep too, but Bullet drops their points once they have slid."};
}

}  // namespace

HardCase restForAMinute() {
  return {
      "D1", "at rest for a minute",
      "forty rocks on a plane, 60 s without sleep, their median and upper tenth: RMS at most 1e-4 of its size, drift "
      "1e-3 (proposed list)",
      runRestForAMinute};
}

}  // namespace cairn::hard
