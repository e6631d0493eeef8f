// SPDX-License-Identifier: Zlib
#include "cairn/core/family.h"

#include <gtest/gtest.h>

#include <random>

#include "every_target.h"
#include "random_tree.h"

namespace cairn::family_test {
namespace {

Family randomFamily(std::mt19937_64& engine) {
  Family family;
  const auto alive = static_cast<std::uint32_t>(1 + engine() % kFamilyWidth);
  for (std::uint32_t lane = 0; lane < alive; ++lane)
    family.set(lane, {Vec3(test::randomPoint(engine)), static_cast<float>(test::uniform(engine))});
  return family;
}

SupportBlock randomBlock(std::mt19937_64& engine) {
  SupportBlock block;
  for (std::uint32_t lane = 0; lane < SupportBlock::kWidth; ++lane) {
    // Few distinct points, so that ties occur.
    const Vec3 p(test::randomPoint(engine));
    const std::uint32_t from = lane > 4 && engine() % 2 == 0 ? static_cast<std::uint32_t>(engine() % lane) : lane;
    block.x[lane] = from == lane ? p.x : block.x[from];
    block.y[lane] = from == lane ? p.y : block.y[from];
    block.z[lane] = from == lane ? p.z : block.z[from];
  }
  return block;
}

using FamilyOnEveryTarget = test::EveryTarget;

TEST_F(FamilyOnEveryTarget, Overlap_SameBitsAsScalarTwin) {
  onEveryTarget([] {
    constexpr std::uint64_t kSeed = 11;
    std::mt19937_64 engine(kSeed);
    for (int i = 0; i < 20000; ++i) {
      const Family family = randomFamily(engine);
      const Sphere s{Vec3(test::randomPoint(engine)), static_cast<float>(test::uniform(engine))};
      ASSERT_EQ(overlap(family, s), overlapScalar(family, s)) << "seed " << kSeed << ", case " << i;
    }
  });
}

TEST_F(FamilyOnEveryTarget, SupportLane_SameLaneAsScalarTwin) {
  onEveryTarget([] {
    constexpr std::uint64_t kSeed = 12;
    std::mt19937_64 engine(kSeed);
    for (int i = 0; i < 20000; ++i) {
      const SupportBlock block = randomBlock(engine);
      const Vec3 direction(test::randomPoint(engine));
      ASSERT_EQ(supportLane(block, direction), supportLaneScalar(block, direction))
          << "seed " << kSeed << ", case " << i;
    }
  });
}

// Lengths here are below 6. The differences of a distance round by a unit of 2^-24, its square by twice that, a
// product's and two sums' units, of which its root has half; the sum of radii and its square likewise: below 8
// together.
TEST(Family, Overlap_AgreesWithExactArithmeticBeyondItsRounding) {
  constexpr double kRounding = 6 * 8 * 0x1p-24;
  std::mt19937_64 engine(13);
  for (int i = 0; i < 20000; ++i) {
    const Family family = randomFamily(engine);
    const Sphere s{Vec3(test::randomPoint(engine)), static_cast<float>(test::uniform(engine))};
    const std::uint32_t bits = overlap(family, s);
    for (std::uint32_t lane = 0; lane < kFamilyWidth; ++lane) {
      const Sphere f = family.sphere(lane);
      const double separation = distance(Vec3d(f.center), Vec3d(s.center)) - double{f.radius} - double{s.radius};
      if (separation > kRounding) ASSERT_EQ((bits >> lane) & 1U, 0U) << "case " << i << ", lane " << lane;
      if (separation < -kRounding) ASSERT_EQ((bits >> lane) & 1U, 1U) << "case " << i << ", lane " << lane;
    }
  }
}

TEST(Family, Overlap_TouchingBallsMeet) {
  Family family;
  family.set(3, {{1, 0, 0}, 0.5F});
  EXPECT_EQ(overlap(family, {{2, 0, 0}, 0.5F}), 1U << 3);
  EXPECT_EQ(overlap(family, {{2, 0, 0}, 0.4999F}), 0U);
}

TEST(Family, DeadLanes_AreNeverHitByAnythingFinite) {
  const Family empty;
  EXPECT_EQ(overlap(empty, {{0, 0, 0}, 1e18F}), 0U);
  EXPECT_EQ(overlap(empty, {{1e18F, -1e18F, 3}, 1e18F}), 0U);
}

}  // namespace
}  // namespace cairn::family_test
