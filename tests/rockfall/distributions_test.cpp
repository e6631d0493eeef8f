// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace cairn::rockfall::distributions_test {
namespace {

TEST(Distribution, InterpolatesItsQuantiles) {
  const Distribution d({4, 1, 3, 2});
  EXPECT_EQ(d.quantile(0), 1);
  EXPECT_EQ(d.median(), 2.5);
  EXPECT_EQ(d.quantile(1), 4);
  EXPECT_DOUBLE_EQ(d.middleHalf(), 1.5);
  EXPECT_EQ(d.shareUpTo(2), 0.5);
  EXPECT_EQ(d.shareUpTo(0.5), 0);
  EXPECT_EQ(Distribution({7}).quantile(0.3), 7);
}

/// Random numbers, many of them equal.
std::vector<double> drawn(std::mt19937& random, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(random() % 20) - 10);
  return values;
}

// The greatest difference of shares just at and between all values.
double slowKolmogorovSmirnov(const Distribution& a, const Distribution& b) {
  double greatest = 0;
  for (const Distribution* d : {&a, &b})
    for (const double value : d->values())
      greatest = std::max(greatest, std::abs(a.shareUpTo(value) - b.shareUpTo(value)));
  return greatest;
}

// Each value as often as the other has values: then both have as many, and the nearest way moves the i-th to the i-th.
double slowWasserstein(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> x, y;
  for (const double value : a) x.insert(x.end(), b.size(), value);
  for (const double value : b) y.insert(y.end(), a.size(), value);
  std::ranges::sort(x);
  std::ranges::sort(y);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::abs(x[i] - y[i]);
  return sum / static_cast<double>(x.size());
}

TEST(Distances, AreThoseOfTheSlowWay) {
  constexpr std::uint32_t kSeed = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int i = 0; i < 300; ++i) {
    const auto a = drawn(random, 1 + random() % 15), b = drawn(random, 1 + random() % 15);
    const Distribution x(a), y(b);
    ASSERT_NEAR(kolmogorovSmirnov(x, y), slowKolmogorovSmirnov(x, y), 1e-12);
    ASSERT_NEAR(wasserstein(x, y), slowWasserstein(a, b), 1e-12);
    ASSERT_EQ(kolmogorovSmirnov(x, x), 0);
    ASSERT_EQ(wasserstein(y, y), 0);
  }
}

// Of two samples of one distribution about one pair in twenty is farther apart.
TEST(KolmogorovSmirnovBound, IsPassedOneTimeInTwenty) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  constexpr int kPairs = 2000;
  int beyond = 0;
  for (int i = 0; i < kPairs; ++i) {
    std::vector<double> a(60), b(90);
    for (double& value : a) value = uniform(random);
    for (double& value : b) value = uniform(random);
    beyond += kolmogorovSmirnov(Distribution(a), Distribution(b)) > kolmogorovSmirnovBound(a.size(), b.size());
  }
  // The bound is asymptotic and a little too wide for samples so small.
  EXPECT_GT(beyond, kPairs * 0.02);
  EXPECT_LT(beyond, kPairs * 0.065);
}

}  // namespace
}  // namespace cairn::rockfall::distributions_test
