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

struct HeapLength {
  int bodies = 200;
  double seconds = 30, watched = 10;
};

/// The fastest rock's speed, the median of the last steps; how many sleep in the end, in per cent; how many are lost.
Figures drop(const test::TriedBody& rock, std::uint64_t seed, bool doSleep, const HeapLength& length) {
  Pile pile(rock, 1, {.bodies = length.bodies, .seed = seed, .doSleep = doSleep});
  std::vector<double> speeds;
  const int steps = int(length.seconds * test::kStepsPerSecond);
  const int from = steps - int(length.watched * test::kStepsPerSecond);
  for (int i = 0; i < steps; ++i) {
    pile.step();
    if (i >= from) speeds.push_back(pile.greatestSpeed());
  }
  const auto asleep = std::ranges::count_if(pile.bodies(), [](const btRigidBody* body) { return !body->isActive(); });
  return {quantileOf(speeds, 0.5, Bound::atMost), 100.0 * double(asleep) / length.bodies, double(pile.countLost())};
}

Outcome runHeapComesToRest(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const HeapLength length = isWhole ? HeapLength{} : HeapLength{.bodies = 20, .seconds = 20, .watched = 5};
  const std::vector<Asked> asked{{"greatest speed, nobody ever asleep", 0.05, Bound::atMost, "m/s"},
                                 {"asleep at the end, where they may", 100, Bound::atLeast, "%", 1},
                                 {"lost", 0, Bound::atMost, "", 1}};
  const auto rock = [](std::uint64_t seed) -> const CaseBodies& { return rocks(seed, 1); };
  const auto run = [&](const CaseBody& body, std::uint64_t seed) -> Figures {
    const Figures awake = drop(body.body, seed, false, length), sleepy = drop(body.body, seed, true, length);
    return {awake[0], sleepy[1], std::max(awake[2], sleepy[2])};
  };
  return {compareSeeds(asked, isWhole ? 3 : 1, rock, run), ""};
}

}  // namespace

HardCase heapComesToRest() {
  return {"D12", "a heap comes to rest",
          "200 rocks, 30 s at 60 Hz, medians of three heaps: the fastest slower than 0.05 m/s in half of the steps of "
          "the last 10 s though nobody sleeps; where they may all of them sleep; nobody lost (proposed list: the "
          "speed of those that may sleep, which is 0 of the asleep)",
          runHeapComesToRest};
}

}  // namespace cairn::hard
