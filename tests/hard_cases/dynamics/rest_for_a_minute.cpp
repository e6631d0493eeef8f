// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>

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
  const std::vector<Asked> asked{{"place, RMS about its mean", 0.01, Bound::atMost, "% of size"},
                                 {"drift", 0.1, Bound::atMost, "% of size"},
                                 {"RMS, friction in two directions", 0.01, Bound::atMost, "% of size"},
                                 {"drift, friction in two directions", 0.1, Bound::atMost, "% of size"}};
  const auto rock = [](std::uint64_t seed) -> const CaseBodies& { return rocks(seed, 1); };
  const auto run = [&](const CaseBody& body, std::uint64_t) {
    LyingStart start{.size = 1, .seconds = isWhole ? 60.0 : 4.0, .settling = isWhole ? 15.0 : 5.0};
    Figures figures = lie(body.body, start);
    start.inTwoDirections = true;
    std::ranges::copy(lie(body.body, start), std::back_inserter(figures));
    return figures;
  };
  return {
      compareSeeds(asked, isWhole ? 40 : 3, rock, run),
      "What is slower than 0.34 mm/s Bullet's solver resists along one direction only, so every shape goes on "
      "along the other, at an even pace; in two directions each step's friction is solved anew, and not to the end."};
}

}  // namespace

HardCase restForAMinute() {
  return {"D1", "at rest for a minute",
          "forty rocks on a plane, 60 s without sleep, their median: RMS at most 1e-4 of its size, drift 1e-3 "
          "(proposed list)",
          runRestForAMinute};
}

}  // namespace cairn::hard
