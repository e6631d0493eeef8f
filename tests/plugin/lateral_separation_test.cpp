// SPDX-License-Identifier: GPL-3.0-or-later
#include "continuous/lateral_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace cairn::bullet::lateral_separation_test {
namespace {

constexpr std::uint32_t kSeed = 20055;

struct Pair {
  std::vector<Vec3> first, second;
  Vec3 along;

  // From the second's farthest point along `direction` to the first's farthest against it.
  Vec3 difference(const Vec3& direction) const {
    const auto less = [&](const Vec3& x, const Vec3& y) { return dot(direction, x) < dot(direction, y); };
    return *std::ranges::min_element(first, less) - *std::ranges::max_element(second, less);
  }
  // By every direction of a fine fan.
  float widestGap() const {
    const Vec3 u = normalized(cross(along, std::abs(along.x) < 0.9F ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    const Vec3 v = cross(along, u);
    float widest = -std::numeric_limits<float>::infinity();
    for (int i = 0; i < 20000; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / 20000;
      const Vec3 direction = u * std::cos(angle) + v * std::sin(angle);
      widest = std::max(widest, dot(direction, difference(direction)));
    }
    return widest;
  }
};

Pair randomPair(std::mt19937& random) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto vector = [&] {
    const float x = unit(random), y = unit(random), z = unit(random);
    return Vec3(x, y, z);
  };
  Pair pair;
  pair.along = normalized(vector());
  const Vec3 apart = vector() * 2.0F;
  const int corners = 1 + static_cast<int>(random() % 16);
  for (int i = 0; i < corners; ++i) {
    pair.first.push_back(vector() + apart);
    pair.second.push_back(vector());
  }
  return pair;
}

TEST(LateralSeparation, AgreesWithAFanOfDirections) {
  std::mt19937 random(kSeed);
  // Between two rays of the fan a gap changes by no more than their angle times the lengths, which are below 8.
  constexpr float kFan = 8 * 2 * std::numbers::pi_v<float> / 20000;
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 500; ++i) {
    const Pair pair = randomPair(random);
    const float separation = pair.widestGap();
    const auto difference = [&](const Vec3& n) { return pair.difference(n); };
    for (const float margin : {0.0F, 0.1F}) {
      const auto found = LateralSeparation(pair.along).direction(pair.difference(pair.along), margin, difference);
      if (found) {
        EXPECT_NEAR(dot(*found, pair.along), 0, 1e-5F);
        EXPECT_GT(dot(*found, pair.difference(*found)), margin) << "seed " << kSeed << ", pair " << i;
      }
      if (separation > margin + kFan)
        EXPECT_TRUE(found) << "seed " << kSeed << ", pair " << i << ", gap " << separation;
    }
    separation > 0.1F + kFan ? ++apart : ++overlapping;
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(overlapping, 50);
}

TEST(LateralSeparation, SaysNothingOfWhatHasNoEnd) {
  const auto infinite = [](const Vec3& n) { return n * -std::numeric_limits<float>::infinity(); };
  EXPECT_FALSE(LateralSeparation(Vec3(1, 0, 0)).direction(Vec3(0, 1, 0), 0, infinite));
  const auto same = [](const Vec3&) { return Vec3(); };
  EXPECT_FALSE(LateralSeparation(Vec3(1, 0, 0)).direction(Vec3(0, 1, 0), 0, same)) << "one point of both";
}

}  // namespace
}  // namespace cairn::bullet::lateral_separation_test
