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

// Of a rock: RMS and drift; of a ball: acceleration over what theory says. Steps in the same proportion everywhere.
Figures at(std::size_t kind, double size, double seconds) {
  const double clock = std::sqrt(size);
  const CaseBodies& bodies = rocks(1, size);
  Figures figures = lie(bodies[kind].body,
                        {.size = size, .seconds = seconds * clock, .settling = 10 * clock, .timeStep = clock / 240});
  const double radius = size / 2;
  figures.push_back(
      rollDown(balls(radius)[kind == 0 ? 0 : kind + 1].body, {.radius = radius, .timeStep = clock / 240}));
  return figures;
}

// By how many times the worse is worse than at a metre, no better than rounding counted as rounding.
Figures ratios(std::size_t kind, double seconds) {
  constexpr double kRounding = 0.01;  // per cent of size: D1's limit
  const Figures usual = at(kind, 1, seconds);
  Figures worst(3, 0);
  for (const double size : {kSmall, kLarge}) {
    const Figures figures = at(kind, size, seconds);
    for (std::size_t i = 0; i < 2; ++i)
      worst[i] = std::max(worst[i], std::max(figures[i], kRounding) / std::max(usual[i], kRounding));
    worst[2] = std::max(worst[2], std::max(figures[2] / usual[2], usual[2] / figures[2]));
  }
  return worst;
}

Outcome run(Effort effort) {
  const double seconds = effort == Effort::whole ? 60 : 3;
  const std::vector<Asked> asked{{"place at rest, RMS, times that of a metre", 2, Bound::atMost, ""},
                                 {"drift, times that of a metre", 2, Bound::atMost, ""},
                                 {"rolling acceleration, times or part of it", 1.02, Bound::atMost, ""}};
  return {besideTheBest(asked, ratios(0, seconds), {{"hull", ratios(1, seconds)}, {"gimpact", ratios(2, seconds)}}),
          ""};
}

}  // namespace

HardCase smallAndLarge() {
  return {"D13", "a centimetre, a hundred metres",
          "D1 and a rolling ball at both sizes, time in proportion to the root of the size: at rest within twice what "
          "a rock of a metre does, rolling within 2 % (proposed: within twice)",
          run};
}

}  // namespace cairn::hard
