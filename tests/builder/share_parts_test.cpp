// SPDX-License-Identifier: GPL-3.0-or-later
// Families for the parts of a surface: what each search promises, checked from its result alone.
#include "levels/share_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "builder_meshes.h"
#include "cover/capacity_assignment.h"
#include "levels/group_parts.h"
#include "surface/convexity.h"

namespace cairn::builder::share_parts_test {
namespace {

constexpr std::size_t kParents = 4, kBranching = 5;

/// A surface cut into as many parts as `count` random points have nearest neighbours.
class PartsOfABall : public testing::TestWithParam<std::uint64_t> {
 protected:
  PartsOfABall() : mesh(test::lumpyBall(2, GetParam())), solid(mesh), depth(solid), parts(15) {
    Pieces pieces = piecesOf(mesh);
    refinePieces(pieces, 500);
    const std::vector<Vec3d> points = cornersOf(pieces);
    std::mt19937_64 random(GetParam());
    std::vector<Vec3d> sites;
    for (std::size_t i = 0; i < parts.size(); ++i) sites.push_back(points[random() % points.size()]);
    for (const Vec3d& p : points) {
      const auto nearer = [&](const Vec3d& a, const Vec3d& b) { return distance(a, p) < distance(b, p); };
      const auto nearest = std::min_element(sites.begin(), sites.end(), nearer);
      parts[static_cast<std::size_t>(nearest - sites.begin())].push(p);
    }
    for (std::size_t i = 0; i < kParents; ++i) start.push_back({points[random() % points.size()], 0, 0});
    start = groupParts(parts, depth, start, kBranching, GetParam());
  }

  /// Stand-off at which each part can hang below one parent, none above more than its share.
  double bottleneck(const SphereSet& parents) const {
    CostTable table{parents.size(), {}};
    for (const PointSet& part : parts)
      for (const Ball& parent : parents)
        table.costs.push_back(part.empty() ? 0 : part.farthest(parent.center).distance - parent.depth);
    const std::vector<std::uint32_t> bins = assignWithin(table, kBranching);
    double worst = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) worst = std::max(worst, table.at(i, bins[i]));
    return worst;
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  std::vector<PointSet> parts;
  SphereSet start;
};

INSTANTIATE_TEST_SUITE_P(Seeds, PartsOfABall, testing::Range<std::uint64_t>(1, 9));

TEST_P(PartsOfABall, GroupingFitsParentsToTheirParts) {
  ASSERT_EQ(start.size(), kParents);
  double worst = 0;
  for (const Ball& parent : start) {
    EXPECT_EQ(parent.depth, depth.depth(parent.center));
    worst = std::max(worst, parent.standOff());
  }
  EXPECT_LE(bottleneck(start), worst * (1 + 1e-12));  // the same distances, added up in another order
}

TEST_P(PartsOfABall, SharingHoldsEveryPartWithinItsPlaces) {
  const SharedParts shared = shareParts(parts, depth, start, 1e-9, kBranching, GetParam());
  std::vector<std::size_t> places(kParents, 0);
  ASSERT_EQ(shared.parentsOf.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<std::uint32_t>& parents = shared.parentsOf[i];
    if (parts[i].empty()) continue;
    ASSERT_TRUE(parents.size() == 1 || parents.size() == 2);
    for (const std::uint32_t k : parents) ++places[k];
    for (std::size_t p = 0; p < parts[i].size(); ++p)
      EXPECT_TRUE(std::any_of(parents.begin(), parents.end(),
                              [&](std::uint32_t k) { return costOf(shared.parents[k], parts[i][p]) <= shared.limit; }));
  }
  for (const std::size_t count : places) EXPECT_LE(count, kBranching);
}

// No part here has more points than are looked at, so the walk starts where the grouping ended.
TEST_P(PartsOfABall, SharingIsAtLeastAsTightAsGrouping) {
  const SharedParts shared = shareParts(parts, depth, start, 1e-9, kBranching, GetParam());
  EXPECT_LE(shared.limit, bottleneck(start) * 1.05) << "looser than one step of the search for room allows";
}

TEST_P(PartsOfABall, SharingStopsAtWhatIsAskedForAndIsTheSameTwice) {
  const double lowest = 0.9 * bottleneck(start);
  const SharedParts first = shareParts(parts, depth, start, lowest, kBranching, 3);
  const SharedParts second = shareParts(parts, depth, start, lowest, kBranching, 3);
  EXPECT_GT(first.limit, 0.99 * lowest);  // lowered by 0.4 % at a time
  EXPECT_EQ(first.limit, second.limit);
  EXPECT_EQ(first.parentsOf, second.parentsOf);
  for (std::size_t k = 0; k < kParents; ++k) EXPECT_EQ(first.parents[k].center, second.parents[k].center);
}

TEST(Convexity, SeesTheDeepestDent) {
  EXPECT_TRUE(isConvex(test::meshOf(test::cuboid({1, 2, 3}, 3)), 1e-12));
  EXPECT_FALSE(isConvex(test::torus(1, 0.3, 16, 8), 0.1));
  TriangleMesh dented = test::meshOf(test::cuboid({2, 2, 2}, 2));
  for (Vec3d& v : dented.vertices)
    if (v.x > 0.99 && std::abs(v.y) < 0.01 && std::abs(v.z) < 0.01) v.x -= 0.1;
  EXPECT_FALSE(isConvex(dented, 0.02));
  // A wall falls by 0.1 over half the face, along one edge or both: the far corner is at most 0.3 in front of its
  // plane.
  EXPECT_TRUE(isConvex(dented, 0.3));
}

}  // namespace
}  // namespace cairn::builder::share_parts_test
