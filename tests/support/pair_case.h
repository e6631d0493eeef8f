// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "cairn/core/traversal.h"
#include "random_tree.h"

namespace cairn::test {

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

inline PairSet setOf(std::span<const NodePair> pairs) {
  PairSet set;
  for (const NodePair& p : pairs) set.insert({p.a, p.b});
  return set;
}

/// Two random trees at random poses.
struct PairCase {
  RandomTree a, b;
  SphereTree treeA, treeB;
  Pose poseA, poseB;
  float margin;
};

inline PairCase randomCase(std::uint64_t seed, std::uint32_t spheresPerNode = 1) {
  std::mt19937_64 engine(seed);
  RandomTree a = randomTree(seed * 2, 300, 3);
  RandomTree b = randomTree(seed * 2 + 1, 200, static_cast<std::uint32_t>(1 + engine() % 3));
  if (spheresPerNode == 2)
    for (RandomTree* tree : {&a, &b}) addBounds(*tree, seed);
  SphereTree treeA = std::move(SphereTree::create(a.data)).value();
  SphereTree treeB = std::move(SphereTree::create(b.data)).value();
  const Pose poseA = randomPose(engine, 1.2);
  const Pose poseB = randomPose(engine, 1.2);
  return {std::move(a), std::move(b), std::move(treeA), std::move(treeB), poseA, poseB, 0.05F};
}

/// The promise of any stop: two points of the bodies closer than the margin lie in a reported pair that may touch.
inline void expectEveryTouchReported(const PairCase& c, const Traversal& traversal) {
  PairSet reported;
  for (const auto& pairs : {traversal.leafPairs(), traversal.front()})
    for (const NodePair& p : pairs)
      if (traversal.mayTouch(p)) reported.insert({p.a, p.b});
  const auto isReported = [&](std::uint32_t recordA, std::uint32_t recordB) {
    for (std::uint32_t a = recordA;; a = c.treeA.data().nodes[a].parent) {
      for (std::uint32_t b = recordB;; b = c.treeB.data().nodes[b].parent) {
        if (reported.contains({c.treeA.nodeAt(a), c.treeB.nodeAt(b)})) return true;
        if (b == 0) break;
      }
      if (a == 0) return false;
    }
  };
  for (std::size_t i = 0; i < c.a.points.size(); ++i)
    for (std::size_t j = 0; j < c.b.points.size(); ++j) {
      const double separation = distance(c.poseA * Vec3d(c.a.points[i]), c.poseB * Vec3d(c.b.points[j]));
      if (separation <= c.margin) ASSERT_TRUE(isReported(c.a.leafOfPoint[i], c.b.leafOfPoint[j])) << i << ", " << j;
    }
}

/// In the world, in double; negative where they overlap.
inline double gapOf(const PairCase& c, const Sphere& a, const Sphere& b) {
  const double reach = a.radius * c.poseA.scale + b.radius * c.poseB.scale + c.margin;
  return distance(c.poseA * Vec3d(a.center), c.poseB * Vec3d(b.center)) - reach;
}

/// Brute force: all pairs of leaves whose bounds overlap, no hierarchy.
inline PairSet overlappingLeaves(const PairCase& c, double slack) {
  PairSet set;
  for (const NodeId a : c.treeA.levelCut(c.treeA.depth()))
    for (const NodeId b : c.treeB.levelCut(c.treeB.depth()))
      if (gapOf(c, c.treeA.bound(a), c.treeB.bound(b)) <= slack) set.insert({a, b});
  return set;
}

/// A lone root.
inline SphereTree treeOfOneBall(const Sphere& ball, std::vector<Sphere> bounds = {}) {
  SphereTreeData data;
  data.bounds = std::move(bounds);
  NodeData& node = data.nodes.emplace_back();
  node.center = ball.center;
  node.radius = ball.radius;
  node.supportCount = 1;
  node.triangleCount = 4;
  data.supportPoints = {ball.center};
  detail::addTetrahedron(data);
  return std::move(SphereTree::create(std::move(data))).value();
}

}  // namespace cairn::test
