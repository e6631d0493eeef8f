// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/advice.h"

#include <gtest/gtest.h>

#include "advise/sieve.h"
#include "advise/take.h"

namespace cairn::advise::advice_test {
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

TEST(Advice, OfEqualMeansTakesTheLowerWorstThenTheQuickerThenTheSmallerTree) {
  std::vector<Candidate> trees = twoTrees();
  trees[0].rungs = {rung(300, 5, 0.1, 0.3)};
  trees[1].rungs = {rung(400, 5, 0.1, 0.2)};
  EXPECT_EQ(bestChoice(trees, 10), (Choice{1, 0}));
  trees[0].rungs[0].worstError = 0.2;
  EXPECT_EQ(bestChoice(trees, 10), (Choice{0, 0}));
  trees[1].rungs[0].p99Us = 4;
  EXPECT_EQ(bestChoice(trees, 10), (Choice{1, 0}));
  trees[0].rungs[0].p99Us = 4;
  EXPECT_EQ(bestChoice(trees, 10), (Choice{0, 0}));
  std::swap(trees[0].spheres, trees[1].spheres);
  EXPECT_EQ(bestChoice(trees, 10), (Choice{1, 0}));
}

TEST(Advice, NamesWhatToBuildSetAndExpect) {
  const std::string text = adviceText(twoTrees(), 39, "rock.obj");
  for (const char* words :
       {"cairn build rock.obj", "--depth 1", "200 operations", "20 us", "20 %", "30 %", "from start to start"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in: " << text;
  EXPECT_EQ(text.find("cut nothing"), std::string::npos);
  EXPECT_NE(adviceText(twoTrees(), 40, "rock.obj").find("cut nothing"), std::string::npos);
  std::vector<Candidate> trees = twoTrees();
  trees[1].rungs.back().budget = 0;
  EXPECT_NE(adviceText(trees, 40, "rock.obj").find("set no budget of operations;"), std::string::npos);
  trees[1].rungs.insert(trees[1].rungs.end() - 1, rung(500, 45, 0.1, 0.2));
  trees[1].rungs[1].cuts = false;
  EXPECT_NE(adviceText(trees, 40, "rock.obj").find("one of 500 cut nothing either, and takes 45 us"),
            std::string::npos);
}

TEST(Advice, NamesTheCheapestWhereNothingFits) {
  EXPECT_EQ(cheapestChoice(twoTrees()), (Choice{0, 0}));
  const std::string text = adviceText(twoTrees(), 9, "rock.obj");
  EXPECT_EQ(text.rfind("No tree", 0), 0U) << text;
  EXPECT_NE(text.find("10 us"), std::string::npos) << text;
}

/// Two playings of a hundred steps of 10 us; in the second so many take 50.
std::vector<std::vector<double>> twoPlayings(std::size_t slow) {
  std::vector<std::vector<double>> times(2, std::vector<double>(100, 10));
  for (std::size_t i = 0; i < slow; ++i) times[1][i] = 50;
  return times;
}

TEST(Take, PercentilesAreOfAllStepsOfAllPlayings) {
  std::vector<std::uint32_t> frames;
  for (std::uint32_t i = 0; i < 100; ++i) frames.push_back(i);
  EXPECT_EQ(stepQuantiles(twoPlayings(2), frames).p99, 10) << "two of two hundred";
  EXPECT_EQ(stepQuantiles(twoPlayings(3), frames).p99, 50)
      << "a step that was fast at its fastest playing is slow where it was slow";
  EXPECT_EQ(stepQuantiles(twoPlayings(100), frames).median, 10);
  frames.resize(10);
  EXPECT_EQ(stepQuantiles(twoPlayings(3), frames).max, 50);
  EXPECT_EQ(stepQuantiles(twoPlayings(0), frames).max, 10);
}

/// Trees of one rung each, which errs by as much as it is told to.
std::vector<Candidate> treesOf(const std::vector<std::pair<double, double>>& p99AndError) {
  std::vector<Candidate> trees;
  for (const auto& [p99Us, error] : p99AndError) trees.push_back({.rungs = {rung(100, p99Us, error, 1)}});
  return trees;
}

TEST(Sieve, KeepsTheHalfThatErrsLeastWithinTheBudget) {
  const auto trees = treesOf({{10, 0.8}, {10, 0.7}, {10, 0.6}, {10, 0.5}, {10, 0.4}, {10, 0.3}, {10, 0.2}, {900, 0.1}});
  EXPECT_EQ(betterHalf(trees, {0, 1, 2, 3, 4, 5, 6, 7}, 100), (std::vector<std::size_t>{3, 4, 5, 6}))
      << "what takes too long comes last, however little it errs";
  EXPECT_EQ(betterHalf(trees, {0, 1, 2, 7}, 100), (std::vector<std::size_t>{0, 1, 2})) << "never fewer than finalists";
  EXPECT_EQ(betterHalf(trees, {0, 7}, 100), (std::vector<std::size_t>{0, 7}));
}

TEST(Sieve, IsLenientWithWhatIsHardlyOverTheBudget) {
  const auto trees = treesOf({{10, 0.8}, {10, 0.7}, {10, 0.6}, {10, 0.5}, {kSieveSlack * 100, 0.1}});
  EXPECT_EQ(betterHalf(trees, {0, 1, 2, 3, 4}, 100), (std::vector<std::size_t>{2, 3, 4}));
  EXPECT_EQ(betterHalf(trees, {0, 1, 2, 3, 4}, 99), (std::vector<std::size_t>{1, 2, 3}));
}

TEST(Sieve, KeepsTheCheapestWhereNothingFits) {
  const auto trees = treesOf({{500, 0.1}, {400, 0.2}, {300, 0.3}, {200, 0.4}});
  EXPECT_EQ(betterHalf(trees, {0, 1, 2, 3}, 100), (std::vector<std::size_t>{1, 2, 3}));
}

}  // namespace
}  // namespace cairn::advise::advice_test
