// SPDX-License-Identifier: Zlib
#include "cairn/core/region_separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "cairn/core/bit_cast.h"
#include "every_target.h"
#include "random_tree.h"

namespace cairn::region_separation_test {
namespace {

constexpr float kExactly = std::numeric_limits<float>::infinity();

/// A tree whose nodes have one to sixteen support points in their balls; with `ties`, on a coarse grid, so that several
/// are often as far along a direction, and centres and radii as well. Every other one has bounds, which are of no
/// concern here.
SphereTree treeWithRegions(std::mt19937_64& engine, bool ties) {
  SphereTreeData data = test::randomTree(engine(), 150, 2).data;
  const auto placed = [&](const Vec3& p) {
    const auto rounded = [](float x) { return std::round(4 * x) / 4; };
    return ties ? Vec3(rounded(p.x), rounded(p.y), rounded(p.z)) : p;
  };
  data.supportPoints.clear();
  for (NodeData& node : data.nodes) {
    node.center = placed(node.center);
    if (ties) node.radius = std::ceil(4 * node.radius) / 4;
    node.firstSupport = static_cast<std::uint32_t>(data.supportPoints.size());
    node.supportCount = static_cast<std::uint32_t>(1 + engine() % kMaxSupportPoints);
    for (std::uint32_t i = 0; i < node.supportCount; ++i)
      data.supportPoints.push_back(placed(node.center + Vec3(test::randomPoint(engine)) * node.radius));
  }
  if (data.nodes.size() % 2 == 0)
    for (const NodeData& node : data.nodes) data.bounds.push_back({node.center * 0.5F, 3 * node.radius});
  return std::move(SphereTree::create(std::move(data))).value();
}

/// A tree at a pose, in a pair frame that is the world's.
struct PlacedCase {
  PlacedCase(SphereTree treeIn, const Pose& pose)
      : tree(std::move(treeIn)), toPair(relativePose(Pose(), pose)), axesFromPair(rounded(transpose(pose.rotation))) {}

  static Mat3 rounded(const Mat3d& m) { return {{Vec3(m.rows[0]), Vec3(m.rows[1]), Vec3(m.rows[2])}}; }
  PlacedRegions regions() const { return {tree, toPair, axesFromPair}; }
  NodeId randomNode(std::mt19937_64& engine) const {
    return tree.nodeAt(static_cast<std::uint32_t>(engine() % tree.nodeCount()));
  }

  SphereTree tree;
  Similarity toPair;
  Mat3 axesFromPair;
};

std::vector<NodePair> randomPairs(std::mt19937_64& engine, const PlacedCase& a, const PlacedCase& b) {
  std::vector<NodePair> pairs(1 + engine() % RegionSeparations::kSize);
  for (NodePair& pair : pairs) pair = {a.randomNode(engine), b.randomNode(engine)};
  return pairs;
}

bool isSameBits(float x, float y) {
  return bitCast<std::uint32_t>(x) == bitCast<std::uint32_t>(y);
}
bool isSameBits(const Vec3& x, const Vec3& y) {
  return isSameBits(x.x, y.x) && isSameBits(x.y, y.y) && isSameBits(x.z, y.z);
}

/// The outcome of the pairs compared.
struct Seen {
  std::size_t beyond = 0, apart = 0, near = 0, blurred = 0;
};

void compareWithOneByOne(const PlacedCase& a, const PlacedCase& b, std::span<const NodePair> pairs,
                         const SeparationLimits& limits, Seen& seen) {
  RegionSeparations separations;
  measureSeparations(a.regions(), b.regions(), pairs, limits, separations);
  ASSERT_EQ((separations.nearPairs | separations.blurredPairs) >> pairs.size(), 0U);
  ASSERT_EQ(separations.nearPairs & separations.blurredPairs, 0U);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "lane " << i << " of " << pairs.size());
    const Vec3 line = a.regions().sphere(pairs[i].a).center - b.regions().sphere(pairs[i].b).center;
    const bool isBlurred = lengthSq(line) < std::numeric_limits<float>::min();
    ASSERT_EQ((separations.blurredPairs >> i & 1U) != 0, isBlurred);
    seen.blurred += isBlurred ? 1 : 0;
    if (isBlurred) continue;
    const Vec3 normal = line / std::sqrt(lengthSq(line));
    ASSERT_TRUE(isSameBits(separations.normal(i), normal));
    const RegionSeparation alone = measureSeparation(a.regions(), b.regions(), pairs[i], normal, limits);
    ASSERT_TRUE(isSameBits(separations.separation[i], alone.separation))
        << separations.separation[i] << " and " << alone.separation;
    ASSERT_EQ((separations.nearPairs >> i & 1U) != 0, alone.isNear);
    if (alone.isNear) ASSERT_TRUE(isSameBits(separations.position(i), alone.position));
    ++(alone.isNear                                                           ? seen.near
       : alone.separation >= limits.reach && alone.separation < limits.atMost ? seen.apart
                                                                              : seen.beyond);
  }
}

using RegionSeparationOnEveryTarget = test::EveryTarget;

TEST_F(RegionSeparationOnEveryTarget, OfUpToEightPairs_SameBitsAsOneByOne) {
  onEveryTarget([] {
    Seen seen;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 engine(seed);
      const PlacedCase a(treeWithRegions(engine, false), test::randomPose(engine, 1));
      const PlacedCase b(treeWithRegions(engine, false), test::randomPose(engine, 1));
      for (int i = 0; i < 100; ++i) {
        SeparationLimits limits{static_cast<float>(test::uniform(engine, 0, 0.1)), 0,
                                static_cast<float>(test::uniform(engine, 0.01, 0.3))};
        limits.atMost = i % 2 == 0 ? limits.reach : kExactly;
        ASSERT_NO_FATAL_FAILURE(compareWithOneByOne(a, b, randomPairs(engine, a, b), limits, seen));
      }
    }
    EXPECT_GT(std::min({seen.beyond, seen.apart, seen.near}), 1000U);
    EXPECT_EQ(seen.blurred, 0U);
  });
}

// Balls in one place and support points of which several are extreme: axes that agree, coordinates that are quarters.
TEST_F(RegionSeparationOnEveryTarget, OfTiesAndOneCentre_SameBitsAsOneByOne) {
  onEveryTarget([] {
    Seen seen;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 engine(seed);
      const auto quarters = [&] { return static_cast<double>(engine() % 5) / 4; };
      const PlacedCase a(treeWithRegions(engine, true), Pose());
      const PlacedCase b(treeWithRegions(engine, true), Pose{Mat3d(), {quarters(), quarters(), quarters()}, 1});
      for (int i = 0; i < 100; ++i) {
        const SeparationLimits limits{0, i % 2 == 0 ? 0.25F : kExactly, 0.25F};
        ASSERT_NO_FATAL_FAILURE(compareWithOneByOne(a, b, randomPairs(engine, a, b), limits, seen));
      }
    }
    EXPECT_GT(std::min({seen.beyond, seen.apart, seen.near}), 1000U);
    EXPECT_GT(seen.blurred, 20U);
  });
}

// Down to distances whose square is no normal float any more, in every lane.
TEST_F(RegionSeparationOnEveryTarget, OfTinyDistances_SameBitsOrBlurred) {
  onEveryTarget([] {
    Seen seen;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 engine(seed);
      const auto atOrigin = [&] {
        SphereTreeData data = test::randomTree(engine(), 20, 0).data;
        data.nodes[0].center = {};
        data.supportPoints = {Vec3(test::randomPoint(engine))};
        return std::move(SphereTree::create(std::move(data))).value();
      };
      const double distance = std::pow(10, test::uniform(engine, -23, -16));
      const PlacedCase a(atOrigin(), Pose()), b(atOrigin(), Pose{Mat3d(), test::randomPoint(engine) * distance, 1});
      const std::vector<NodePair> pairs(1 + engine() % RegionSeparations::kSize, NodePair{kRootNode, kRootNode});
      ASSERT_NO_FATAL_FAILURE(compareWithOneByOne(a, b, pairs, {0, kExactly, 1}, seen));
    }
    EXPECT_GT(std::min(seen.near, seen.blurred), 100U);
  });
}

}  // namespace
}  // namespace cairn::region_separation_test
