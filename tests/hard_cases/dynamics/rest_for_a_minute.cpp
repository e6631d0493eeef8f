// SPDX-License-Identifier: GPL-3.0-or-later
#include "lying.h"

#include "compare.h"
#include "dynamics_cases.h"

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
                                 {"drift", 0.1, Bound::atMost, "% of size"}};
  std::vector<Figures> ours;
  std::vector<std::vector<Figures>> stock(2);
  const int count = isWhole ? 10 : 3;
  for (int seed = 1; seed <= count; ++seed) {
    const CaseBodies& bodies = rocks(std::uint64_t(seed), 1);
    const LyingStart start{.size = 1, .seconds = isWhole ? 60.0 : 4.0, .settling = isWhole ? 15.0 : 5.0};
    ours.push_back(lie(bodies[0].body, start));
    for (std::size_t i = 0; i < stock.size(); ++i) stock[i].push_back(lie(bodies[i + 1].body, start));
  }
  return {
      besideTheBest(asked, medianOf(ours), {{"hull", medianOf(stock[0])}, {"gimpact", medianOf(stock[1])}}),
      "Bullet's friction gives way a little in every step, at an even pace: RMS is the drift over the root of twelve, "
      "and no shape stays where it is."};
}

}  // namespace

HardCase restForAMinute() {
  return {"D1", "at rest for a minute",
          "ten rocks on a plane, 60 s without sleep, their median: RMS at most 1e-4 of its size, drift 1e-3 "
          "(proposed list)",
          runRestForAMinute};
}

}  // namespace cairn::hard
