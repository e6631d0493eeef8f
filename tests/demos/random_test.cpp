// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/figures/random.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/figures/quantiles.h"

namespace cairn::scenes::random_test {
namespace {

constexpr int kDraws = 20000;
/// Five standard errors of a mean of kDraws values of variance 1/3 (a component of a unit vector; also bounds 1/12).
const double kMeanTolerance = 5 * std::sqrt(1.0 / 3 / kDraws);

TEST(Random_Streams, DoNotShareNumbers) {
  Random a(1, 0), b(1, 1), c(2, 0), again(1, 0);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.bits();
    EXPECT_EQ(bits, again.bits());
    EXPECT_NE(bits, b.bits());
    EXPECT_NE(bits, c.bits());
  }
}

TEST(Random_Uniform, StaysInRangeAndIsBalanced) {
  Random random(3);
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, kMeanTolerance);
}

TEST(Random_Direction, IsAUnitVectorWithoutPreference) {
  Random random(4);
  Vec3d sum;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3d d = random.direction();
    ASSERT_NEAR(length(d), 1, 1e-12);
    sum += d;
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis] / kDraws, 0, kMeanTolerance);
}

TEST(Random_Rotation, TurnsAVectorInNoPreferredDirection) {
  Random random(5);
  Vec3d sum;
  for (int i = 0; i < kDraws; ++i) {
    const btVector3 v = quatRotate(random.rotation(), btVector3(1, 0, 0));
    sum += Vec3d(v.x(), v.y(), v.z());
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis] / kDraws, 0, kMeanTolerance);
}

TEST(Quantiles_NearestRank, AreValuesOfTheSample) {
  std::vector<double> sample;
  for (int i = 1000; i >= 1; --i) sample.push_back(i);
  const Quantiles q = quantilesOf(sample);
  EXPECT_EQ(q.median, 500);
  EXPECT_EQ(q.p99, 990);
  EXPECT_EQ(q.p999, 999);
  EXPECT_EQ(q.max, 1000);
  EXPECT_EQ(quantilesOf({3, 1, 2}).median, 2);
  EXPECT_EQ(quantilesOf({3, 1}).p99, 3);
  EXPECT_EQ(quantilesOf({}).max, 0);
}

}  // namespace
}  // namespace cairn::scenes::random_test
