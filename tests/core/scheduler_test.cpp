// SPDX-License-Identifier: Zlib
#include "cairn/core/scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "cairn/core/round_robin.h"
#include "cairn/core/tree_pair_traversal.h"
#include "random_tree.h"

namespace cairn::scheduler_test {
namespace {

/// A handful of bodies, every two of which are a pair.
struct Crowd {
  explicit Crowd(std::uint64_t seed, std::size_t bodies = 6) {
    std::mt19937_64 engine(seed);
    tree = std::make_unique<SphereTree>(std::move(SphereTree::create(test::randomTree(seed).data)).value());
    for (std::size_t i = 0; i < bodies; ++i) poses.push_back(test::randomPose(engine, 1));
    traversals.resize(bodies * (bodies - 1) / 2);
    start();
  }

  void start() {
    pairs.clear();
    std::size_t k = 0;
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (std::size_t j = 0; j < i; ++j, ++k) {
        traversals[k].start(*tree, *tree, poses[i], poses[j], 0.01F);
        pairs.push_back({.id = 1000 - k, .traversal = &traversals[k]});  // ids descend: the scheduler has to sort
      }
  }

  float worstError() const {
    float worst = 0;
    for (const TreePairTraversal& t : traversals) worst = std::max(worst, t.worstError());
    return worst;
  }

  std::unique_ptr<SphereTree> tree;
  std::vector<Pose> poses;
  std::vector<TreePairTraversal> traversals;
  std::vector<ScheduledPair> pairs;
};

std::uint64_t fullCost(std::uint64_t seed) {
  Crowd crowd(seed);
  RoundRobin priority;
  Budget budget = Budget::unlimited();
  EXPECT_EQ(Scheduler().run(crowd.pairs, priority, budget), Progress::done);
  return budget.used();
}

TEST(Scheduler, Budget_IsNeverExceededAndUsedUpToOneStep) {
  const std::uint64_t full = fullCost(1);
  ASSERT_GT(full, 10000U);
  for (const std::uint64_t operations : {0ULL, 1ULL, 9ULL, 10ULL, 79ULL, 100ULL, 1000ULL, 10000ULL}) {
    Crowd crowd(1);
    RoundRobin priority;
    Budget budget = Budget::operations(operations);
    EXPECT_EQ(Scheduler().run(crowd.pairs, priority, budget), Progress::budgetSpent);
    EXPECT_LE(budget.used(), operations);
    EXPECT_LT(operations - budget.used(), Scheduler::kStepOperations);
  }
}

TEST(Scheduler, WorstError_FallsAsTheBudgetGrows) {
  float last = std::numeric_limits<float>::infinity();
  for (const std::uint64_t operations : {0ULL, 300ULL, 3000ULL, 30000ULL, 300000000ULL}) {
    Crowd crowd(1);
    RoundRobin priority;
    Budget budget = Budget::operations(operations);
    (void)Scheduler().run(crowd.pairs, priority, budget);
    EXPECT_LE(crowd.worstError(), last) << operations << " operations";
    last = crowd.worstError();
  }
  EXPECT_LT(last, Crowd(1).worstError());
}

TEST(Scheduler, ManySmallSteps_EndWhereOneBigOneDoes) {
  Crowd whole(2), pieces(2);
  RoundRobin p1, p2;
  Budget unlimited = Budget::unlimited();
  ASSERT_EQ(Scheduler().run(whole.pairs, p1, unlimited), Progress::done);
  std::uint64_t used = 0;
  for (Progress progress = Progress::budgetSpent; progress != Progress::done;) {
    Budget budget = Budget::operations(137);
    progress = Scheduler().run(pieces.pairs, p2, budget);
    used += budget.used();
  }
  EXPECT_EQ(used, unlimited.used());
  for (std::size_t k = 0; k < whole.traversals.size(); ++k)
    EXPECT_TRUE(std::ranges::equal(whole.traversals[k].leafPairs(), pieces.traversals[k].leafPairs())) << k;
}

/// How many turns each pair got.
struct TurnCount final : TurnListener {
  explicit TurnCount(std::size_t pairs) : turns(pairs) {}
  void turnEnded(std::size_t pair, Progress, Budget&) override { ++turns[pair]; }
  std::vector<int> turns;
};

TEST(Scheduler, ShareOut_GivesEachThatIsUnfinishedAsMuchAsTheOthers) {
  for (const std::uint64_t seed : {1U, 2U, 3U})
    for (const std::uint64_t operations : {0ULL, 9ULL, 10ULL, 80ULL, 500ULL, 3000ULL, 30000ULL}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << operations << " operations");
      Crowd crowd(seed);
      const std::vector<std::size_t> chosen{0, 2, 3, 7, 8, 11, 14};
      TurnCount count(crowd.pairs.size());
      Budget budget = Budget::operations(1000000);
      Scheduler().shareOut(crowd.pairs, chosen, operations, budget, &count);
      EXPECT_LE(budget.used(), operations);
      int most = 0, fewest = std::numeric_limits<int>::max();
      for (std::size_t k = 0; k < crowd.pairs.size(); ++k) {
        if (!std::ranges::count(chosen, k)) {
          EXPECT_EQ(count.turns[k], 0) << k;
        } else if (!crowd.traversals[k].done()) {
          most = std::max(most, count.turns[k]);
          fewest = std::min(fewest, count.turns[k]);
        }
      }
      if (most == 0) continue;  // no turn, or all are done
      EXPECT_LE(most - fewest, 1);
      EXPECT_LT(operations - budget.used(), Scheduler::kStepOperations) << "some are unfinished";
    }
}

TEST(Scheduler, ShareOut_LeavesToTheOthersWhatOneDoesNotNeed) {
  Crowd apart(1), together(1);
  std::vector<std::size_t> all(apart.pairs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::uint64_t needed = 0;
  for (const std::size_t k : all) {
    Budget budget = Budget::unlimited();
    (void)Scheduler().runAlone(apart.pairs, k, budget);
    needed += budget.used();
  }
  Budget budget = Budget::unlimited();
  Scheduler().shareOut(together.pairs, all, needed + Scheduler::kStepOperations, budget);
  EXPECT_EQ(budget.used(), needed);
  for (const std::size_t k : all) EXPECT_TRUE(together.traversals[k].done()) << k;
}

TEST(Scheduler, ShareOut_EndsWithTheBudget) {
  Crowd crowd(1);
  const std::vector<std::size_t> chosen{0, 1, 2, 3, 4, 5};
  Budget budget = Budget::operations(200);
  Scheduler().shareOut(crowd.pairs, chosen, 5000, budget);
  EXPECT_LE(budget.used(), 200U);
  EXPECT_LT(200 - budget.used(), Scheduler::kStepOperations);
}

TEST(RoundRobin, NoPairStarves_WhenABudgetServesOnlyOneTurn) {
  Crowd crowd(3);
  RoundRobin priority;
  std::vector<std::size_t> before(crowd.traversals.size());
  for (std::size_t k = 0; k < before.size(); ++k) before[k] = crowd.traversals[k].front().size();
  for (std::size_t step = 0; step < 2 * crowd.traversals.size(); ++step) {  // newcomers have every other turn
    Budget budget = Budget::operations(Scheduler::kTurnOperations);
    (void)Scheduler().run(crowd.pairs, priority, budget);
  }
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k] == 0) continue;  // its roots did not touch
    EXPECT_TRUE(crowd.traversals[k].done() || crowd.traversals[k].front()[0] != (NodePair{kRootNode, kRootNode})) << k;
  }
}

TEST(RoundRobin, NoPairStarves_WhenNewPairsKeepComing) {
  Crowd crowd(3, 2), others(3, 12);
  RoundRobin priority;
  ASSERT_FALSE(crowd.traversals[0].done());
  // The old pair, and in each step one that has never been seen; the budget lets one turn through.
  for (std::uint64_t step = 0; step < 40; ++step) {
    std::vector<ScheduledPair> pairs{{.id = 1, .traversal = &crowd.traversals[0]},
                                     {.id = step + 2, .traversal = &others.traversals[step]}};
    Budget budget = Budget::operations(Scheduler::kTurnOperations);
    (void)Scheduler().run(pairs, priority, budget);
  }
  EXPECT_TRUE(crowd.traversals[0].done());
}

TEST(RoundRobin, OrderOfPairs_DoesNotMatter) {
  Crowd one(4), other(4);
  std::mt19937_64 engine(5);
  std::shuffle(other.pairs.begin(), other.pairs.end(), engine);
  RoundRobin p1, p2;
  Budget b1 = Budget::operations(5000), b2 = Budget::operations(5000);
  (void)Scheduler().run(one.pairs, p1, b1);
  (void)Scheduler().run(other.pairs, p2, b2);
  for (std::size_t k = 0; k < one.traversals.size(); ++k) {
    EXPECT_TRUE(std::ranges::equal(one.traversals[k].front(), other.traversals[k].front())) << k;
    EXPECT_TRUE(std::ranges::equal(one.traversals[k].leafPairs(), other.traversals[k].leafPairs())) << k;
  }
}

TEST(Budget, ZeroMicroseconds_DoesNothing) {
  Crowd crowd(1);
  RoundRobin priority;
  Budget budget = Budget::time(0);
  EXPECT_EQ(Scheduler().run(crowd.pairs, priority, budget), Progress::budgetSpent);
  EXPECT_EQ(budget.used(), 0U);
}

TEST(Budget, Time_EndsALongRun) {
  // A clock that has run out must be noticed within one clock interval and one turn of work.
  Budget budget = Budget::both(Budget::kUnlimited, 1);
  while (budget.charge(1)) {
  }
  EXPECT_LT(budget.used(), std::uint64_t{1} << 40);
  const std::uint64_t used = budget.used();
  EXPECT_FALSE(budget.charge(0)) << "stays spent";
  EXPECT_EQ(budget.used(), used);
}

TEST(Budget, WhatIsGuaranteed_IsDoneWhenTheTimeIsUp) {
  Budget budget = Budget::time(0);
  budget.guarantee(3 * Budget::kClockInterval);
  std::uint64_t done = 0;
  while (budget.charge(8)) done += 8;
  EXPECT_GE(done, 3 * Budget::kClockInterval);
  EXPECT_LE(done, 4 * Budget::kClockInterval);
}

TEST(Budget, Both_EndsAtWhicheverComesFirst) {
  Budget budget = Budget::both(20, 1e9);
  EXPECT_TRUE(budget.charge(15));
  EXPECT_FALSE(budget.charge(6)) << "does not fit and takes nothing";
  EXPECT_TRUE(budget.charge(5));
  EXPECT_FALSE(budget.charge(1));
  EXPECT_TRUE(budget.charge(0));
  budget.forceCharge(7);
  EXPECT_EQ(budget.used(), 27U);
  EXPECT_EQ(budget.remaining(), 0U);
}

TEST(Budget, Promises_AreHeldBackUntilTheyAreRedeemed) {
  Budget budget = Budget::operations(100);
  budget.reserve({60, 0});
  EXPECT_EQ(budget.remaining(), 40U);
  EXPECT_FALSE(budget.charge(41));
  EXPECT_TRUE(budget.charge(40));
  EXPECT_FALSE(budget.charge(1));
  budget.release({60, 0});
  budget.forceCharge(55);
  EXPECT_EQ(budget.used(), 95U);
  EXPECT_EQ(budget.remaining(), 5U);
}

TEST(Budget, PromisesBeyondWhatIsLeft_LeaveNothing) {
  Budget budget = Budget::operations(10);
  budget.reserve({60, 0});
  EXPECT_EQ(budget.remaining(), 0U);
  EXPECT_FALSE(budget.charge(1));
}

TEST(Budget, TimeThatIsPromisedIsNotFree) {
  Budget budget = Budget::time(3600e6);
  EXPECT_GT(budget.nanosecondsFree(), 3599e9);
  EXPECT_FALSE(budget.isLate());
  budget.reserve({0, 3000e9});
  EXPECT_GT(budget.nanosecondsLeft(), 3599e9);
  EXPECT_LT(budget.nanosecondsFree(), 601e9);
  EXPECT_FALSE(budget.isLate());
  budget.reserve({0, 1000e9});
  EXPECT_LT(budget.nanosecondsFree(), 0);
  EXPECT_TRUE(budget.isLate());
  budget.release({0, 4000e9});
  EXPECT_FALSE(budget.isLate());
  EXPECT_FALSE(Budget::operations(0).isLate()) << "which has no deadline";
}

// An hour is left, and promised work needs a day: for refinement the time is up.
TEST(Budget, PromisedTime_IsHeldBack) {
  Budget budget = Budget::time(3600e6);
  EXPECT_TRUE(budget.charge(1));
  const Reservation day{0, 86400e9};
  budget.reserve(day);
  budget.forceCharge(Budget::kClockInterval);
  EXPECT_FALSE(budget.charge(1));
  budget.release(day);
  EXPECT_TRUE(budget.charge(1));
}

/// Promises what every leaf pair will cost, as who measures contacts would.
struct LeafPairsPromised final : TurnListener {
  explicit LeafPairsPromised(const std::vector<ScheduledPair>& all) : pairs(all), reserved(all.size()) {}
  void turnEnded(std::size_t pair, Progress /*progress*/, Budget& budget) override {
    const std::uint64_t now = kCost * pairs[pair].traversal->leafPairs().size();
    budget.reserve({now - reserved[pair], 0});
    sum += now - reserved[pair];
    reserved[pair] = now;
  }

  static constexpr std::uint64_t kCost = 5;
  const std::vector<ScheduledPair>& pairs;  // of the step
  std::vector<std::uint64_t> reserved;
  std::uint64_t sum = 0;
};

TEST(Scheduler, WhatIsPromised_IsLeftOfTheBudget) {
  constexpr std::uint64_t kMaxInATurn = 8 * kFamilyWidth * LeafPairsPromised::kCost;
  const std::uint64_t full = fullCost(1);
  for (const std::uint64_t operations : {full / 2, full * 3 / 4, full}) {
    Crowd crowd(1);
    RoundRobin priority;
    LeafPairsPromised listener(crowd.pairs);
    Budget budget = Budget::operations(operations);
    EXPECT_EQ(Scheduler().run(crowd.pairs, priority, budget, &listener), Progress::budgetSpent);
    EXPECT_GT(listener.sum, 0U) << "nothing was promised: the test shows nothing";
    EXPECT_LE(budget.used() + listener.sum, operations + kMaxInATurn);
  }
}

}  // namespace
}  // namespace cairn::scheduler_test
