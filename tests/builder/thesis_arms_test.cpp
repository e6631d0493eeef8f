// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the thesis's text says of its own constructions, checked on trees that bear its names. Each test fails where one
// of our shortcuts, which serve our own optimiser, takes the construction's place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "balls/enclosing_ball.h"
#include "balls/piece.h"
#include "builder_meshes.h"
#include "cover/optimise_one_by_one.h"
#include "hierarchy/region_tree.h"
#include "regions/drop_spheres.h"
#include "regions/method_traits.h"
#include "regions/reduce.h"
#include "spheres/burst.h"

namespace cairn::builder::thesis_arms_test {
namespace {

// Distances of solids of size 1 to 3, each rounded by 2^-53 of its size.
constexpr double kRounding = 1e-12;

SplitSettings settingsOf(Method method, Optimiser optimiser) {
  SplitSettings settings{method, 8, 1, 1e-6};
  settings.optimiser = optimiser;
  return settings;
}

/// A whole solid as a region, with all corners of its pieces as points.
struct Whole {
  explicit Whole(TriangleMesh m) : mesh(std::move(m)), solid(mesh), depth(solid), root(rootRegion(solid, 1200)) {
    points = PointSet(cornersOf(root.pieces));
    for (const Piece& piece : root.pieces) spacing = std::max(spacing, std::sqrt(longestEdgeSq(piece)));
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  Region root;
  PointSet points;
  double spacing = 0;
};

// 5.3.3 and Eq. 5.3: all spheres have the same stand-off, and the selection ends when all of P is covered (Alg. 6). A
// selection among some of the points leaves others outside.
TEST(ThesisArms, ExpandedSpheres_HaveOneStandOffAndHoldEveryPoint) {
  for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{2}}) {
    const Whole whole(test::lumpyBall(2, seed));
    ASSERT_GT(whole.points.size(), 300U);
    const SphereSet set = reduce({whole.points, whole.depth, 8}, whole.root, whole.spacing, whole.solid,
                                 settingsOf(Method::expand, Optimiser::none), 0);
    ASSERT_GE(set.size(), 2U);
    for (const Ball& ball : set) EXPECT_NEAR(ball.standOff(), set[0].standOff(), kRounding);
    EXPECT_LE(coverStandOff(whole.points, set), set[0].standOff() + kRounding) << "seed " << seed;
  }
}

/// The listing of Alg. 11, with the worst certified error of the division as the error of a set. At least two spheres
/// stay.
std::vector<Ball> balancedByHand(const Split& full, const Whole& whole, const SplitSettings& settings) {
  const bool optimises = settings.optimiser == Optimiser::thesis;
  const auto errorOfSet = [&](const SphereSet& set) {
    const Split split = splitAsTheyAre(full, set, whole.solid, settings);
    return split.children.size() < 2 ? 1e300 : split.worst();
  };
  SphereSet s = full.balls;
  const std::size_t all = full.children.size();
  for (std::size_t n = all - 1; n >= 2; --n) {
    const double allowed = full.worst() * allowedGrowth(*settings.balance, all, n);
    SphereSet t = burst({full.points, whole.depth, n}, s);
    if (errorOfSet(t) > allowed && optimises) t = optimiseOneByOne({full.points, whole.depth, t.size()}, t);
    if (errorOfSet(t) > allowed) break;
    s = t;
  }
  if (s.size() < full.balls.size() && optimises) {
    const SphereSet last = optimiseOneByOne({full.points, whole.depth, s.size()}, s);
    if (errorOfSet(last) <= errorOfSet(s)) s = last;
  }
  return s;
}

// 6.3, Alg. 11: spheres are removed by burst, one at a time, and only the thesis's own optimiser helps.
TEST(ThesisArms, BalancedSets_AreThoseOfTheListing) {
  const Whole whole(test::torus(1, 0.35, 24, 12));
  for (const Optimiser optimiser : {Optimiser::none, Optimiser::thesis})
    for (const Method method : {Method::merge, Method::expand}) {
      SCOPED_TRACE(std::string(methodName(method)) + " " + optimiserName(optimiser));
      SplitSettings settings = settingsOf(method, optimiser);
      settings.balance = constantExcess(0.2);
      const Split full = splitRegion(whole.root, whole.solid, settings, 0);
      const Split dropped = dropSpheres(full, whole.root, whole.solid, settings);
      const std::vector<Ball> byHand = balancedByHand(full, whole, settings);
      ASSERT_EQ(dropped.balls.size(), byHand.size());
      for (std::size_t i = 0; i < byHand.size(); ++i) {
        EXPECT_EQ(dropped.balls[i].center, byHand[i].center);
        EXPECT_EQ(dropped.balls[i].radius, byHand[i].radius);
      }
    }
}

RegionTree grown(const Whole& whole, Method method) {
  const SplitSettings settings = settingsOf(method, Optimiser::none);
  return growRegionTree(whole.root, 2, whole.solid, settings, [](auto...) { return true; });
}

// 7.1.5: a node of a hybrid tree has the smallest sphere around its region, and one of least error around the
// same. 6.1, Alg. 8: "minimum error sphere around Q", which grid's trees have too, as the author's own program makes
// them.
TEST(ThesisArms, GridTrees_ShareTheirRegionsAndDifferInTheSphereOfEach) {
  for (const std::uint64_t seed : {std::uint64_t{3}, std::uint64_t{4}}) {
    const Whole whole(test::lumpyBall(2, seed));
    const RegionTree grid = grown(whole, Method::grid), volume = grown(whole, Method::gridVolume),
                     hybrid = grown(whole, Method::hybrid);
    ASSERT_EQ(grid.size(), volume.size());
    ASSERT_EQ(grid.size(), hybrid.size());
    double gridSum = 0, volumeSum = 0, hybridSum = 0;
    for (std::size_t i = 1; i < grid.size(); ++i) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", node " + std::to_string(i));
      EXPECT_EQ(grid[i].region.pieces, volume[i].region.pieces);
      EXPECT_EQ(grid[i].region.pieces, hybrid[i].region.pieces);
      const std::vector<Vec3d> corners = cornersOf(grid[i].region.pieces);
      EXPECT_NEAR(volume[i].region.ball.radius, smallestEnclosingBall(corners).radius, kRounding);
      EXPECT_LE(hybrid[i].region.error, volume[i].region.error);
      gridSum += grid[i].region.error;
      volumeSum += volume[i].region.error;
      hybridSum += hybrid[i].region.error;
    }
    // The patches of a nearly round solid are flat: balls around them with centres deep inside err far less.
    EXPECT_LT(gridSum, 0.7 * volumeSum);
    EXPECT_LT(hybridSum, 0.7 * volumeSum);
  }
}

// 7.1.5: "Each node of the sphere-tree contains the minimum volume bounding sphere, as produced by the grid algorithm,
// and a minimum error sphere covering the same region."
TEST(ThesisArms, HybridTrees_HaveTheVolumesBoundsAndTheLeastErrorsSpheres) {
  const TriangleMesh mesh = test::lumpyBall(2, 3);
  const auto dataOf = [&](Method method, bool twoSpheres) {
    BuildOptions options;
    options.method = method;
    options.depth = 2;
    options.samples = 1000;
    options.twoSpheres = twoSpheres;
    return buildTree(mesh, options).value().data();
  };
  const SphereTreeData volume = dataOf(Method::gridVolume, false), least = dataOf(Method::hybrid, false);
  SphereTreeData two = dataOf(Method::hybrid, true);
  ASSERT_EQ(two.bounds.size(), volume.nodes.size());
  double errors = 0, errorsOfBounds = 0, radii = 0, radiiOfBounds = 0;
  for (std::size_t i = 0; i < two.bounds.size(); ++i) {
    EXPECT_EQ(two.bounds[i], (Sphere{volume.nodes[i].center, volume.nodes[i].radius})) << "node " << i;
    errors += two.nodes[i].error;
    errorsOfBounds += volume.nodes[i].error;
    radii += two.nodes[i].radius;
    radiiOfBounds += two.bounds[i].radius;
  }
  EXPECT_LT(errors, 0.7 * errorsOfBounds);
  EXPECT_LT(radiiOfBounds, 0.9 * radii);
  two.bounds.clear();
  two.info = least.info;
  EXPECT_EQ(two, least) << "all else is the tree of one sphere a node";
}

// 3.3, Alg. 1: spheres get smaller until too many are needed, so that a family has several children; and no sphere has
// more stand-off than the whole region's one, which is what a family of less than two would leave.
TEST(ThesisArms, GridFamilies_HaveSeveralChildrenWithLessErrorThanTheirParent) {
  const Whole whole(test::meshOf(test::ball(1, 3)));
  const RegionTree tree = grown(whole, Method::grid);
  double parents = 0, children = 0;
  for (const RegionNode& node : tree) {
    if (node.childCount == 0) continue;
    EXPECT_GE(node.childCount, 2U);
    double worst = 0;
    for (std::uint32_t c = 0; c < node.childCount; ++c) worst = std::max(worst, tree[node.firstChild + c].region.error);
    parents += node.region.error;
    children += worst;
  }
  EXPECT_GT(tree.size(), 20U);
  EXPECT_LT(children, parents);
}

}  // namespace
}  // namespace cairn::builder::thesis_arms_test
