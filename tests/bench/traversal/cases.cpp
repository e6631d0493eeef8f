// SPDX-License-Identifier: Zlib
#include "traversal/cases.h"

#include <bit>
#include <cmath>
#include <utility>

#include "cairn/core/state_hash.h"
#include "random_tree.h"
#include "test_trees.h"

namespace cairn::bench {

namespace {
constexpr std::uint32_t kTrianglesPerLeaf = 2;
// Of the root's radius: the poses' centres fill a cube of this half-width, from one inside the other to barely
// touching.
constexpr double kSpread = 0.8;
constexpr float kMargin = 0.001F;
}  // namespace

std::shared_ptr<const SphereTree> ringTree(std::uint32_t leaves) {
  // A ring of s segments has s^2 triangles; they are halved until a leaf has two.
  const auto segments = static_cast<int>(std::sqrt(static_cast<double>(leaves) * kTrianglesPerLeaf));
  return test::plainTree(test::torus(1, 0.4, segments / 2 * 2), kTrianglesPerLeaf);
}

std::shared_ptr<const SphereTree> cloudTree(std::uint32_t points) {
  const auto depth = static_cast<std::uint32_t>(std::log(static_cast<double>(points)) / std::log(4.0));
  return std::make_shared<const SphereTree>(
      std::move(SphereTree::create(test::randomTree(1, points, depth).data)).value());
}

TraversalCase makeCase(std::string name, std::shared_ptr<const SphereTree> tree, std::size_t poseCount,
                       std::uint64_t seed) {
  TraversalCase c;
  c.name = std::move(name);
  c.tree = std::move(tree);
  std::mt19937_64 engine(seed);
  const double size = c.tree->sphere(kRootNode).radius;
  c.margin = kMargin * static_cast<float>(size);
  StateHash hash;
  for (std::size_t i = 0; i < poseCount; ++i) {
    const Mat3d rotation = test::randomRotation(engine);
    c.poses.push_back({rotation, test::randomPoint(engine) * (kSpread * size), 1});
    test::ReferenceTraversal reference(*c.tree, *c.tree, {}, c.poses.back(), c.margin);
    while (reference.refineOne() > 0) {
    }
    const Similarity* lastMove = nullptr;
    for (const test::FamilyStep& step : reference.steps) {
      c.families.push_back(static_cast<std::uint32_t>(step.family - c.tree->families().data()));
      c.others.push_back(step.otherNode);
      c.sphereTests += static_cast<std::uint64_t>(std::popcount(step.livingLanes));
      if (lastMove != step.move) c.moves.push_back({*step.move, step.margin, 0});
      lastMove = step.move;
      ++c.moves.back().count;
    }
    for (const NodePair& pair : reference.leafPairs) hash.add(std::uint64_t{pair.a} << 32 | pair.b);
  }
  c.hash = hash.hex();
  return c;
}

}  // namespace cairn::bench
