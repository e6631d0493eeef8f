// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/share_spheres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace cairn::builder::share_spheres_test {
namespace {

/// Errors of solids as functions of their spheres.
ErrorsOf errorsFrom(const std::function<double(std::uint32_t solid, std::uint32_t spheres)>& error) {
  return [error](const std::vector<SphereCount>& asked) -> Result<std::vector<double>> {
    std::vector<double> errors;
    for (const auto& [solid, spheres] : asked) errors.push_back(error(solid, spheres));
    return errors;
  };
}

TEST(ShareSpheres, GivesAllAndNearlyTheLeastSumOfErrors) {
  const double sizes[] = {1, 4, 9};
  const auto error = [&](std::uint32_t solid, std::uint32_t n) { return sizes[solid] / n; };
  for (const std::uint32_t total : {3U, 4U, 10U, 37U, 200U}) {
    const auto given = shareSpheres({{0, 1}, {1, 1}, {2, 1}}, total, errorsFrom(error));
    ASSERT_TRUE(given.ok());
    EXPECT_EQ(std::accumulate(given.value().begin(), given.value().end(), 0U), total);
    double sum = 0, best = 1e300;
    for (std::uint32_t s = 0; s < 3; ++s) sum += error(s, given.value()[s]);
    for (std::uint32_t a = 1; a + 2 <= total; ++a)
      for (std::uint32_t b = 1; a + b + 1 <= total; ++b)
        best = std::min(best, error(0, a) + error(1, b) + error(2, total - a - b));
    // Numbers asked for grow by a half, so a share is at most that far from its best.
    EXPECT_LE(sum, 1.1 * best) << total;
  }
}

TEST(ShareSpheres, SeesBehindAStepWithoutGain) {
  // Two spheres gain nothing, four gain nearly all; the other solid falls slowly.
  const auto error = [](std::uint32_t solid, std::uint32_t n) {
    if (solid == 0) return n < 4 ? 10.0 : 0.1;
    return 1.0 / n;
  };
  const auto given = shareSpheres({{0, 1}, {1, 1}}, 8, errorsFrom(error));
  ASSERT_TRUE(given.ok());
  EXPECT_GE(given.value()[0], 4U);
}

TEST(ShareSpheres, CopiesCostEach) {
  const auto error = [](std::uint32_t, std::uint32_t n) { return 1.0 / n; };
  const auto given = shareSpheres({{0, 4}, {1, 1}}, 21, errorsFrom(error));
  ASSERT_TRUE(given.ok());
  const std::uint32_t used = 4 * given.value()[0] + given.value()[1];
  EXPECT_LE(used, 21U);
  EXPECT_GT(used, 21U - 1U);  // the single one takes what is over
}

TEST(ShareSpheres, PassesFailuresOn) {
  const auto given = shareSpheres({{0, 1}}, 5, [](const auto&) { return Result<std::vector<double>>(Error{"no"}); });
  ASSERT_FALSE(given.ok());
  EXPECT_EQ(given.error().message, "no");
}

}  // namespace
}  // namespace cairn::builder::share_spheres_test
