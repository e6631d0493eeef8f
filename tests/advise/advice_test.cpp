// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/advice.h"

#include <gtest/gtest.h>

namespace cairn::advise {
namespace {

Rung rung(std::uint64_t budget, double p99Us, double meanError, double worstError) {
  return {.budget = budget,
          .meanOperations = 1000,
          .medianUs = 10,
          .p99Us = p99Us,
          .meanError = meanError,
          .worstError = worstError};
}

std::vector<Candidate> twoTrees() {
  Candidate coarse{.depth = 1, .spheres = 9, .rungs = {rung(100, 10, 0.5, 0.9), rung(200, 20, 0.2, 0.3)}};
  Candidate fine{.depth = 3, .spheres = 585, .rungs = {rung(100, 15, 0.6, 0.9), rung(400, 40, 0.1, 0.2)}};
  fine.rungs.back().cuts = false;
  return {coarse, fine};
}

TEST(Advice, TakesTheLowestMeanErrorThatFits) {
  EXPECT_EQ(bestChoice(twoTrees(), 100), (Choice{1, 1}));
  EXPECT_EQ(bestChoice(twoTrees(), 40), (Choice{1, 1})) << "as much as is allowed fits";
  EXPECT_EQ(bestChoice(twoTrees(), 39), (Choice{0, 1}));
  EXPECT_EQ(bestChoice(twoTrees(), 19), (Choice{0, 0}));
  EXPECT_EQ(bestChoice(twoTrees(), 9), std::nullopt);
}

TEST(Advice, OfEqualMeansTakesTheLowerWorstThenTheSmallerBudgetThenTheSmallerTree) {
  std::vector<Candidate> trees = twoTrees();
  trees[0].rungs = {rung(300, 5, 0.1, 0.3)};
  trees[1].rungs = {rung(400, 5, 0.1, 0.2)};
  EXPECT_EQ(bestChoice(trees, 10), (Choice{1, 0}));
  trees[0].rungs[0].worstError = 0.2;
  EXPECT_EQ(bestChoice(trees, 10), (Choice{0, 0}));
  trees[0].rungs[0].budget = 400;
  EXPECT_EQ(bestChoice(trees, 10), (Choice{0, 0}));
  std::swap(trees[0].spheres, trees[1].spheres);
  EXPECT_EQ(bestChoice(trees, 10), (Choice{1, 0}));
}

TEST(Advice, NamesWhatToBuildSetAndExpect) {
  const std::string text = adviceText(twoTrees(), 39, "rock.obj");
  for (const char* words : {"cairn build rock.obj", "--depth 1", "200 operations", "20 us", "20 %", "30 %"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in: " << text;
  EXPECT_EQ(text.find("cuts nothing"), std::string::npos);
  EXPECT_NE(adviceText(twoTrees(), 40, "rock.obj").find("cuts nothing"), std::string::npos);
}

TEST(Advice, NamesTheCheapestWhereNothingFits) {
  EXPECT_EQ(cheapestChoice(twoTrees()), (Choice{0, 0}));
  const std::string text = adviceText(twoTrees(), 9, "rock.obj");
  EXPECT_EQ(text.rfind("No tree", 0), 0U) << text;
  EXPECT_NE(text.find("10 us"), std::string::npos) << text;
}

}  // namespace
}  // namespace cairn::advise
