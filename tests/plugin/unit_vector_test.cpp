// SPDX-License-Identifier: Zlib
#include "placement/unit_vector.h"

#include <gtest/gtest.h>

#include "random_tree.h"

namespace cairn::bullet::unit_vector_test {
namespace {

// Half a unit of each coordinate, and of the root and the sum of their squares.
constexpr double kRounding = 4 * 0x1p-24;

TEST(UnitVector, HasLengthOneHoweverShortItWas) {
  std::mt19937_64 engine(12);
  for (int exponent = -126; exponent <= 60; ++exponent)
    for (int trial = 0; trial < 20; ++trial) {
      const Vec3d direction = normalized(test::randomPoint(engine));
      const Vec3 v(direction * std::ldexp(1.0, exponent));
      EXPECT_NEAR(length(Vec3d(unitVector(v))), 1, kRounding) << "2^" << exponent;
      EXPECT_GT(dot(Vec3d(unitVector(v)), Vec3d(v)), 0);
    }
  EXPECT_EQ(unitVector(Vec3()), Vec3());
}

TEST(UnitVector, IsTheQuotientWhereverSquaresKeepTheirDigits) {
  std::mt19937_64 engine(13);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 v(test::randomPoint(engine));
    EXPECT_EQ(unitVector(v), normalized(v));
  }
}

}  // namespace
}  // namespace cairn::bullet::unit_vector_test
