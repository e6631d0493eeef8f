// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn::accuracy_cost::statistics_test {
namespace {

// A few operations on numbers of size one.
constexpr double kRounding = 1e-12;

// Means 2 and 3 around 2.5: 3 (1/4 + 1/4) = 1.5 between, with one degree of freedom; (1 + 0 + 1) twice = 4 within, with
// four. F = 1.5. With t^2 = F and four degrees of freedom Student's distribution has a closed form:
// P = 1 - sin a (1 + cos^2 a / 2) with tan a = t / 2.
TEST(Anova, AgreesWithAHandComputedExample) {
  const Anova anova = anovaOf({{1, 2, 3}, {2, 3, 4}});
  EXPECT_EQ(anova.between, 1U);
  EXPECT_EQ(anova.within, 4U);
  EXPECT_NEAR(anova.f, 1.5, kRounding);
  const double angle = std::atan(std::sqrt(1.5) / 2), cosine = std::cos(angle);
  EXPECT_NEAR(anova.p, 1 - std::sin(angle) * (1 + cosine * cosine / 2), kRounding);
  EXPECT_NEAR(anova.fCritical, 7.7086, 5e-5) << "as tables of the F distribution print it, to four digits";
}

// The thesis prints 3.9151 for five models of table 7.1: 1 and 128 degrees of freedom, 65 stand-offs for each
// heuristic.
TEST(Anova, HasTheThesissCriticalValue) {
  std::vector<double> values(65);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  const Anova anova = anovaOf({values, values});
  EXPECT_NEAR(anova.fCritical, 3.9151, 5e-5);
  EXPECT_EQ(anova.f, 0);
  EXPECT_EQ(anova.p, 1);
}

TEST(Anova, IsCertainWhereNothingVariesInsideTheGroups) {
  const Anova differ = anovaOf({{1, 1}, {2, 2}});
  EXPECT_TRUE(std::isinf(differ.f));
  EXPECT_EQ(differ.p, 0);
  EXPECT_EQ(anovaOf({{1, 1}, {1, 1}}).p, 1);
}

TEST(Statistics, MeansAndLinearity) {
  EXPECT_NEAR(geometricMean(std::vector{2.0, 8.0}), 4, kRounding);
  EXPECT_TRUE(std::isnan(geometricMean({})));
  EXPECT_EQ(mean(std::vector{1.0, 2.0, 6.0}), 3);
  EXPECT_NEAR(linearity(std::vector{1.0, 2.0, 3.0}, std::vector{5.0, 3.0, 1.0}), 1, kRounding);
  // Deviations -1, 0, 1 and -1, 2, -1: no common part.
  EXPECT_NEAR(linearity(std::vector{1.0, 2.0, 3.0}, std::vector{0.0, 3.0, 0.0}), 0, kRounding);
  EXPECT_TRUE(std::isnan(linearity(std::vector{1.0, 1.0, 1.0}, std::vector{0.0, 3.0, 0.0})));
}

}  // namespace
}  // namespace cairn::accuracy_cost::statistics_test
