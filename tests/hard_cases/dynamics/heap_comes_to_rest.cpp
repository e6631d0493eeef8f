// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "compare.h"
#include "dynamics_cases.h"
#include "pile.h"

// 200 rocks dropped into a pit: they come to lie, and all of them are there.
//
//    | o O  |
//    |O oO O|
//    |oOoOoO|
//    '------'
namespace cairn::hard {
namespace {

Figures drop(const test::TriedBody& rock, int bodies, double seconds, double watched) {
  Pile pile(rock, 1, {.bodies = bodies, .doSleep = true});
  std::vector<double> speeds;
  const int steps = int(seconds * test::kStepsPerSecond), from = int((seconds - watched) * test::kStepsPerSecond);
  for (int i = 0; i < steps; ++i) {
    pile.step();
    if (i >= from) speeds.push_back(pile.greatestSpeed());
  }
  std::ranges::sort(speeds);
  return {speeds[speeds.size() / 2], double(pile.countLost())};
}

Outcome runHeapComesToRest(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const std::vector<Asked> asked{{"greatest speed, median of the last steps", 0.05, Bound::atMost, "m/s"},
                                 {"lost", 0, Bound::atMost, ""}};
  return {
      compare(asked, rocks(1, 1),
              [&](const CaseBody& body) { return isWhole ? drop(body.body, 200, 30, 10) : drop(body.body, 20, 8, 1); }),
      ""};
}

}  // namespace

HardCase heapComesToRest() {
  return {"D12", "a heap comes to rest",
          "200 rocks that may sleep, 30 s at 60 Hz: the fastest slower than 0.05 m/s in half of the steps of the last "
          "10 s, nobody "
          "lost (proposed list)",
          runHeapComesToRest};
}

}  // namespace cairn::hard
