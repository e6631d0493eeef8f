// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"

// Ten cubes of a metre, each five millimetres aside of the column's axis, every one another way.
//
//     [ ]
//      [ ]
//     [ ]   x 10
//      [ ]
//   =======
namespace cairn::hard {
namespace {

constexpr double kEdge = 1;

Outcome runStackOfTen(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const double size = kEdge * std::sqrt(3.0);
  const test::StackStart start{
      .seconds = isWhole ? 20 : 3, .iterations = 30, .edge = btScalar(kEdge), .aside = btScalar(0.005)};
  const std::vector<Asked> asked{{"sideways drift, median", 5, Bound::atMost, "% of size"},
                                 {"top too low or too high, worst", 5, Bound::atMost, "% of size"}};
  const std::vector<Measure> measures = compare(asked, cubes(kEdge), [&](const CaseBody& body) -> Figures {
    const std::vector<test::StackRun> runs = test::runStacks(body.body, start, isWhole ? 9 : 3);
    double height = 0;
    for (const test::StackRun& each : runs) height = test::greatest(height, std::abs(each.settling));
    return {100 * test::quantile(runs, &test::StackRun::drift, 0.5) / size, 100 * height / size};
  });
  return {measures, ""};
}

}  // namespace

HardCase stackOfTen() {
  return {"D2", "a stack of ten",
          "ten cubes, 20 s at 60 Hz and 30 iterations, nine stacks: median drift below 0.05 of the size, the top as "
          "near where it was (proposed list)",
          runStackOfTen};
}

}  // namespace cairn::hard
