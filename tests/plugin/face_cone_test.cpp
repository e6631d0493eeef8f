// SPDX-License-Identifier: Zlib
#include "placement/face_cone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "random_tree.h"
#include "test_trees.h"

namespace cairn::bullet::face_cone_test {
namespace {

using test::uniform;

TEST(FaceCone, HoldsEverySumOfItsNormalsAndNothingFarFromThem) {
  constexpr std::uint64_t kSeed = 21;
  std::mt19937_64 engine(kSeed);
  const std::vector<Vec3> faces{{1, 0, 0}, {0, 1, 0}, normalized(Vec3(-0.3F, 0.2F, 1))};
  int outside = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const float x = float(uniform(engine, -1, 1)), y = float(uniform(engine, -1, 1)), z = float(uniform(engine, -1, 1));
    const Vec3 sum = faces[0] * x + faces[1] * y + faces[2] * z;
    if (lengthSq(sum) < 0.01F) continue;
    const Vec3 direction = normalized(sum);
    const float shortfall = std::min({x, y, z}) / length(sum);
    if (shortfall >= 0) EXPECT_TRUE(isAmongNormals(faces, direction)) << "seed " << kSeed << ", trial " << trial;
    // A normal's share is at least its distance from the plane of the others: beyond the slack it is outside.
    if (shortfall > -2 * kConeSlack) continue;
    ++outside;
    EXPECT_FALSE(isAmongNormals(faces, direction)) << "seed " << kSeed << ", trial " << trial;
  }
  EXPECT_GT(outside, 100);
  EXPECT_FALSE(isAmongNormals({}, Vec3(0, 0, 1)));
}

// How many of a tree's leaves consist of flat faces with sharp edges.
std::uint32_t facetedLeaves(const SphereTree& tree) {
  std::uint32_t count = 0;
  for (const NodeId leaf : tree.levelCut(tree.depth())) count += tree.isFaceted(leaf);
  return count;
}

TEST(FacetedLeaves, AreThoseOfSharpEdgesAndNotOfSmoothBodies) {
  // Three triangles a leaf: some lie over an edge.
  const auto cube = test::plainTree(test::cuboid({1, 1, 1}, 2), 3);
  EXPECT_EQ(facetedLeaves(*cube), cube->leafCount());
  // Facets of a ball of 800 triangles meet at 9 degrees or so.
  const auto ball = test::plainTree(test::ball(1, 10), 12);
  EXPECT_EQ(facetedLeaves(*ball), 0U);
}

}  // namespace
}  // namespace cairn::bullet::face_cone_test
