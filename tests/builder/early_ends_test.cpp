// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that end as soon as their outcome is known, each against the one that goes on to the end.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "balls/enclosing_ball.h"
#include "builder_meshes.h"
#include "certify/protrusion.h"
#include "regions/method_traits.h"
#include "regions/split_region.h"

namespace cairn::builder::early_ends_test {
namespace {

using test::randomPoint;
using test::uniform;

constexpr std::uint64_t kSeed = 20261122;

TEST(EarlyEnds, Protrusion_IsTheSameUpToWhatIsOfInterestAndKnownToBeMoreBeyond) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 engine(kSeed);
  const TriangleMesh mesh = test::lumpyBall(2, 8);
  const SignedDistance solid(mesh);
  const ProtrusionTolerance whole = defaultProtrusionTolerance(solid);
  std::size_t beyond = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d center = randomPoint(engine);
    const double radius = uniform(engine);
    const double error = certifiedProtrusion(solid, center, radius, whole).upper;
    ProtrusionTolerance some = whole;
    some.ofInterest = uniform(engine);
    const double known = certifiedProtrusion(solid, center, radius, some).upper;
    if (error > some.ofInterest) {
      ++beyond;
      EXPECT_GT(known, some.ofInterest);
      EXPECT_GE(known, error);
    } else {
      EXPECT_EQ(known, error);
    }
  }
  EXPECT_GT(beyond, 30U);
  EXPECT_LT(beyond, 270U);
}

TEST(EarlyEnds, EnclosingBallSearch_GivesTheBitsOfASearchMadeAnew) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 engine(kSeed);
  EnclosingBallSearch search;
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec3d> points(1 + engine() % 40);
    for (Vec3d& p : points) p = randomPoint(engine);
    const EnclosingBall anew = smallestEnclosingBall(points), again = search.around(points);
    EXPECT_EQ(again.center, anew.center);
    EXPECT_EQ(again.radius, anew.radius);
  }
}

TEST(EarlyEnds, SplitBelowAGoal_IsTheWholeSplitOrNothing) {
  SplitSettings settings{Method::merge, 8, 1, 1e-6};
  settings.optimiser = Optimiser::cairn;
  const TriangleMesh mesh = test::torus(1, 0.3, 24, 12);
  const SignedDistance solid(mesh);
  const Region whole = rootRegion(solid, 600);
  Split plain, refined;
  Region root;
  // Of the parts of the body, the first whose division can be refined.
  for (const Region& part : splitRegion(whole, solid, settings, 0).children) {
    root = part;
    plain = splitRegion(root, solid, settings, 0);
    refined = refineSplit(plain, root, solid, settings, 1);
    if (refined.worst() < plain.worst()) break;
  }
  ASSERT_LT(refined.worst(), plain.worst());
  const auto below = [&](double goal) { return splitBelow(root, {}, solid, settings, 1, goal); };
  const auto sameAs = [](const Split& a, const Split& b) {
    if (a.children.size() != b.children.size()) return false;
    for (std::size_t i = 0; i < a.children.size(); ++i)
      if (a.children[i].error != b.children[i].error || a.children[i].pieces != b.children[i].pieces) return false;
    return true;
  };
  const std::optional<SplitBelow> easy = below(1.01 * plain.worst());
  ASSERT_TRUE(easy);
  EXPECT_FALSE(easy->refined);
  EXPECT_TRUE(sameAs(easy->split, plain));
  const std::optional<SplitBelow> hard = below(0.5 * (plain.worst() + refined.worst()));
  ASSERT_TRUE(hard);
  EXPECT_TRUE(hard->refined);
  EXPECT_TRUE(sameAs(hard->split, refined));
  EXPECT_FALSE(below(refined.worst()));
}

TEST(EarlyEnds, SplitLikeAnother_IsBelowTheGoalToo) {
  const TriangleMesh mesh = test::lumpyBall(2, 8);
  const SignedDistance solid(mesh);
  SplitSettings settings{Method::merge, 8, 1, 1e-6};
  settings.optimiser = Optimiser::cairn;
  const Region root = rootRegion(solid, 600);
  const Split plain = splitRegion(root, solid, settings, 0);
  const double goal = 1.05 * plain.worst();
  const std::optional<SplitBelow> again = splitBelow(root, plain, solid, settings, 1, goal);
  ASSERT_TRUE(again);
  EXPECT_GE(again->split.children.size(), 2U);
  EXPECT_LT(again->split.worst(), goal);
}

}  // namespace
}  // namespace cairn::builder::early_ends_test
