// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"
#include "lying.h"
#include "rolling.h"

// A rock of a centimetre, one of a hundred metres: the same but for the clock, which goes by the root of the size.
//
//    .            .-'''-.
//    o     =     /       '.
//               |     +    )
namespace cairn::hard {
namespace {

constexpr double kSmall = 0.01, kLarge = 100;

// RMS of a rock's place; a ball's acceleration over what theory says. Steps in the same proportion everywhere.
Figures at(std::size_t kind, double size, double seconds) {
  const double clock = std::sqrt(size), radius = size / 2;
  const LyingStart start{.size = size, .seconds = seconds * clock, .settling = 10 * clock, .timeStep = clock / 240};
  const test::TriedBody& ball = balls(radius)[kind == 0 ? 0 : kind + 1].body;
  return {lie(rocks(1, size)[kind].body, start).front(), rollDown(ball, {.radius = radius, .timeStep = clock / 240})};
}

Outcome runSmallAndLarge(Effort effort) {
  const double seconds = effort == Effort::whole ? 60 : 3;
  std::vector<Figures> all;
  double usualRms = 0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const Figures usual = at(kind, 1, seconds), small = at(kind, kSmall, seconds), large = at(kind, kLarge, seconds);
    if (kind == 0) usualRms = usual[0];
    const double off = test::greatest(std::abs(small[1] / usual[1] - 1), std::abs(large[1] / usual[1] - 1));
    all.push_back({small[0], large[0], 100 * off});
  }
  const std::vector<Asked> asked{{"a centimetre at rest, RMS", 2 * usualRms, Bound::atMost, "% of size"},
                                 {"a hundred metres at rest, RMS", 2 * usualRms, Bound::atMost, "% of size"},
                                 {"rolling, off that of a metre", 2, Bound::atMost, "%"}};
  return {besideTheBest(asked, all[0], {{"hull", all[1]}, {"gimpact", all[2]}}),
          "Bullet has lengths of its own, which are much to a centimetre: its shapes creep more there, too."};
}

}  // namespace

HardCase smallAndLarge() {
  return {
      "D13", "a centimetre, a hundred metres",
      "D1 and a rolling ball at both sizes, time in proportion to the root of the size: at rest at most twice the RMS "
      "of a rock of a metre, rolling within 2 % (proposed: within twice)",
      runSmallAndLarge};
}

}  // namespace cairn::hard
