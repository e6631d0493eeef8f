// SPDX-License-Identifier: Zlib
#include "dispatch/step_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "cairn/core/scheduler.h"
#include "dispatch/step_tuning.h"

namespace cairn::test::step_plan_test {
namespace {

using bullet::CostModel;
using bullet::PairEstimate;
using bullet::StepMeans;
using bullet::StepPlan;

constexpr unsigned kSeed = 5;

std::vector<PairEstimate> randomNeeds(std::mt19937_64& engine, std::size_t count) {
  std::vector<PairEstimate> needs;
  for (std::size_t i = 0; i < count; ++i)
    needs.push_back({double(engine() % 16) / 16, 10 + engine() % 500, engine() % 8 != 0, engine() % 2 == 0});
  return needs;
}

StepPlan planOf(const std::vector<PairEstimate>& needs, StepMeans means) {
  StepPlan plan;
  for (const PairEstimate& need : needs) plan.add(need);
  plan.decide(means, CostModel(), CostModel());
  return plan;
}

TEST(StepPlan, HoldsNobodyWhenThereIsEnoughForAll) {
  EXPECT_FALSE(planOf({{1, 100, true, true}, {0, 200, true, false}}, {.operations = 300}).isScarce());
  EXPECT_TRUE(planOf({{1, 100, true, true}, {0, 200, true, false}}, {.operations = 299}).isScarce());
}

TEST(StepPlan, ServesWhatCannotBeHeldWhateverIsLeft) {
  const StepPlan plan = planOf({{0, 100, false, true}, {1, 100, true, true}, {2, 100, true, true}}, {.operations = 0});
  const std::vector<std::size_t> chosen(plan.chosen().begin(), plan.chosen().end());
  EXPECT_EQ(chosen, (std::vector<std::size_t>{0, 2})) << "and of the others the most urgent one";
}

// Two turns of 80 operations at the pace before anything was seen, 50 ns: 9.5 us with what a pair takes whatever it is.
TEST(StepPlan, ServesNoneWhereHoldingLeavesNoTimeAndThatMayBe) {
  const auto planned = [](double nanoseconds, bool mayServeNone) {
    StepPlan plan;
    for (int i = 0; i < 2; ++i) plan.add({1, 1000, true, true});
    plan.decide({.nanoseconds = nanoseconds}, CostModel(), CostModel(5), mayServeNone);
    return plan;
  };
  constexpr double kHolding = 2 * 150, kTurns = 9500;
  EXPECT_TRUE(planned(kHolding + kTurns - 1, true).servesNone());
  EXPECT_EQ(planned(kHolding + kTurns + 1, true).chosen().size(), 1U);
  EXPECT_EQ(planned(kHolding, false).chosen().size(), 1U);
  EXPECT_FALSE(planned(1e9, true).servesNone()) << "enough for all";
}

TEST(StepPlan, NeverCutsAnAnswerShortAndCutsOneThatHasNone) {
  StepPlan plan = planOf({{3, 100, true, false}, {2, 100, true, false}, {1, 100, true, true}}, {.operations = 110});
  ASSERT_EQ(plan.chosen().size(), 1U);
  EXPECT_FALSE(plan.decideOnMore({.operations = 60}, CostModel())) << "its answer serves better than half a new one";
  EXPECT_TRUE(plan.decideOnMore({.operations = 100}, CostModel()));
  EXPECT_FALSE(plan.decideOnMore({.operations = 40}, CostModel()));
  EXPECT_TRUE(plan.decideOnMore({.operations = 60}, CostModel()));
  EXPECT_TRUE(plan.carriedOver().empty());
}

// It has nothing to say; `outruns`: nor would an answer last.
PairEstimate unanswered(double urgency, bool outruns) {
  return {.urgency = urgency,
          .operations = 400,
          .canBeCarriedOver = true,
          .mayBeCut = true,
          .isUnanswered = true,
          .outrunsAnswers = outruns};
}

TEST(StepPlan, HasEachLookedAtCoarselyBeforeAnyGetsAll) {
  std::vector<PairEstimate> needs(20, unanswered(1, false));
  needs.push_back({.urgency = 2, .operations = 300, .canBeCarriedOver = true});
  const StepPlan plan = planOf(needs, {.operations = 1000});
  EXPECT_EQ(plan.coarse().size(), 20U);
  EXPECT_EQ(double(plan.coarseOperations()),
            std::floor(bullet::step_tuning::kCoarseShare * double(1000 - 21 * StepPlan::kCarryOverOperations)));
  EXPECT_EQ(std::vector<std::size_t>(plan.chosen().begin(), plan.chosen().end()), std::vector<std::size_t>{20});
  for (const std::size_t i : plan.coarse()) EXPECT_FALSE(plan.sharesTheRest(i));
}

TEST(StepPlan, FinishesNoneWhoseAnswerWouldNotLast) {
  const StepPlan plan = planOf({unanswered(3, true), unanswered(1, false), unanswered(2, true)}, {.operations = 900});
  EXPECT_EQ(plan.coarse().size(), 3U);
  EXPECT_EQ(plan.coarseOperations(), 3 * Scheduler::kTurnOperations) << "no more than a turn each";
  EXPECT_EQ(std::vector<std::size_t>(plan.chosen().begin(), plan.chosen().end()), std::vector<std::size_t>{1});
  EXPECT_TRUE(plan.sharesTheRest(0) && plan.sharesTheRest(2));
}

TEST(StepPlan, LooksAtEachOrAtNoneThatCanBeHeld) {
  std::vector<PairEstimate> needs;
  for (int i = 0; i < 30; ++i) needs.push_back(unanswered(i, i % 2 == 0));
  needs.push_back({.operations = 400, .canBeCarriedOver = false, .mayBeCut = true, .isUnanswered = true});
  const double holding = double(30 * StepPlan::kCarryOverOperations),
               enough = 31 * Scheduler::kStepOperations / bullet::step_tuning::kCoarseShare;
  EXPECT_EQ(planOf(needs, {.operations = holding + enough + 1}).coarse().size(), 31U);
  const StepPlan none = planOf(needs, {.operations = holding + enough - 1});
  EXPECT_EQ(std::vector<std::size_t>(none.coarse().begin(), none.coarse().end()), std::vector<std::size_t>{30});
  EXPECT_EQ(none.carriedOver().size() + none.chosen().size(), 30U) << "none is forgotten";
}

// The overhead of a look is most of a short one.
TEST(StepPlan, LooksAtEachForAWholeTurnOrAtNoneWhereTimeEnds) {
  const auto looked = [](double share) {
    StepPlan plan;
    for (int i = 0; i < 8; ++i) plan.add(unanswered(1, true));
    const double turns = 8 * CostModel().expectedNanoseconds(Scheduler::kTurnOperations);
    const double holding = 8 * CostModel(5).expectedNanoseconds(0);
    plan.decide({.nanoseconds = holding + share * turns / bullet::step_tuning::kCoarseShare}, CostModel(),
                CostModel(5));
    EXPECT_EQ(plan.coarse().size() + plan.carriedOver().size() + plan.chosen().size(), 8U) << "none is forgotten";
    return plan.coarse().size();
  };
  EXPECT_EQ(looked(1.01), 8U);
  EXPECT_EQ(looked(0.99), 0U);
}

TEST(StepPlan, WeighsUrgencyByImportance) {
  StepPlan plan;
  for (int i = 0; i < 2; ++i) plan.add({1, 100, true, true});
  ASSERT_TRUE(plan.isTooMuchFor({.operations = 100}, CostModel()));
  plan.weigh(0, 0.5);
  plan.decide({.operations = 100}, CostModel(), CostModel());
  ASSERT_FALSE(plan.chosen().empty());
  EXPECT_EQ(plan.chosen()[0], 1U);
}

// Against what the rule says, word for word: one after the other, the most urgent first.
TEST(StepPlan, ChoosesTheMostUrgentThatFitTogether) {
  std::mt19937_64 engine(kSeed);
  int scarce = 0;
  for (int run = 0; run < 300; ++run) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", run " << run);
    const std::vector<PairEstimate> needs = randomNeeds(engine, engine() % 40);
    double left = double(engine() % 8000);
    const StepPlan plan = planOf(needs, {.operations = left});
    if (!plan.isScarce()) continue;
    ++scarce;
    std::vector<std::size_t> order;
    std::set<std::size_t> expected;
    for (std::size_t i = 0; i < needs.size(); ++i) {
      left -= needs[i].canBeCarriedOver ? double(StepPlan::kCarryOverOperations) : double(needs[i].operations);
      if (needs[i].canBeCarriedOver)
        order.push_back(i);
      else
        expected.insert(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return needs[x].urgency > needs[y].urgency; });
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k > 0 && left < double(needs[order[k]].operations)) break;
      expected.insert(order[k]);
      left -= double(needs[order[k]].operations);
    }
    EXPECT_EQ(std::set<std::size_t>(plan.chosen().begin(), plan.chosen().end()), expected);
    EXPECT_EQ(plan.carriedOver().size() + expected.size(), needs.size());
  }
  EXPECT_GT(scarce, 100);
}

}  // namespace
}  // namespace cairn::test::step_plan_test
