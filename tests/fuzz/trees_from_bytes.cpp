// SPDX-License-Identifier: GPL-3.0-or-later
#include "trees_from_bytes.h"

#include <set>
#include <utility>

#include "random_tree.h"
#include "require.h"
#include "test_trees.h"

namespace cairn::fuzz {
namespace {

// Of the seeds of a byte, those that give trees two spheres a node.
constexpr std::uint64_t kFirstOfTwoSpheres = 192;

KnownTree withCorners(std::shared_ptr<const SphereTree> tree) {
  KnownTree known{std::move(tree), {}};
  for (std::uint32_t record = 0; record < known.tree->nodeCount(); ++record) {
    const NodeId leaf = known.tree->nodeAt(record);
    if (!known.tree->isLeaf(leaf)) continue;
    std::set<std::uint32_t> corners;
    for (const std::uint32_t t : known.tree->regionTriangles(leaf))
      corners.insert(known.tree->triangles()[t].begin(), known.tree->triangles()[t].end());
    for (const std::uint32_t v : corners) known.surface.push_back({known.tree->vertices()[v], leaf});
  }
  return known;
}

KnownTree cloud(Bytes& bytes) {
  const std::uint64_t seed = bytes.next();
  const std::uint32_t points = 1 + bytes.below(60), depth = bytes.below(4);
  const auto size = static_cast<float>(bytes.powerOfTen(9));
  test::RandomTree random = test::randomTree(seed, points, depth);
  if (seed >= kFirstOfTwoSpheres) test::addBounds(random, seed);
  test::scaleTree(random.data, size);
  for (NodeData& node : random.data.nodes)
    node.error = 2 * node.radius;  // the far side of a ball from a point on its near side
  KnownTree known;
  auto tree = SphereTree::create(std::move(random.data));
  require(tree.ok(), "a tree of a cloud of points was refused");
  known.tree = std::make_shared<const SphereTree>(std::move(tree).value());
  for (std::size_t i = 0; i < random.points.size(); ++i)
    known.surface.push_back({random.points[i] * size, known.tree->nodeAt(random.leafOfPoint[i])});
  return known;
}

void damage(SphereTreeData& data, Bytes& bytes) {
  NodeData& node = data.nodes[bytes.below(std::uint32_t(data.nodes.size()))];
  const auto factor = static_cast<float>(bytes.powerOfTen(bytes.below(8) == 1 ? 30 : 3));
  const Vec3 shift{float(bytes.between(-2, 2)), float(bytes.between(-2, 2)), float(bytes.between(-2, 2))};
  const auto any = [&](auto& list) -> auto& {
    return list[bytes.below(std::uint32_t(list.size()))];
  };
  switch (bytes.below(9)) {
    case 0:
      node.radius *= factor;
      return;
    case 1:
      node.center += shift;
      return;
    case 2:
      node.error *= factor;
      return;
    case 3:
      node.innerRadius = node.radius * float(bytes.part());
      return;
    case 4:
      node.normalCone = {normalized(shift + Vec3(0, 0, 1e-3F)), float(bytes.between(-1, 1))};
      return;
    case 5:
      any(data.supportPoints) = shift * factor;
      return;
    case 6:
      if (!data.faceNormals.empty()) any(data.faceNormals) = normalized(shift + Vec3(0, 0, 1e-3F));
      return;
    case 7:
      any(data.vertices) = shift * factor;
      return;
    default:
      any(data.triangles)[bytes.below(3)] = bytes.below(std::uint32_t(data.vertices.size()));
  }
}

}  // namespace

std::span<const KnownTree> solidTrees() {
  static const std::vector<KnownTree> all = [] {
    const test::Solid cube = test::cuboid({1, 1, 1}, 1);
    std::vector<KnownTree> trees;
    for (const auto& tree :
         {test::plainTree(cube), test::plainTree(cube, 12), test::plainTree(test::cuboid({1, 0.7, 0.4}, 3)),
          test::plainTree(test::ball(0.5, 3)), test::plainTree(test::ball(0.5, 5), 4),
          test::plainTree(test::torus(0.5, 0.15, 12)), test::plainTree(test::twoCuboids({0.4, 0.3, 0.3}, {1, 0, 0}, 2)),
          test::plainTree(test::cuboid({1, 1, 1e-3}, 2)), test::plainTree(test::cuboid({2, 0.02, 0.02}, 2)),
          test::plainTree(test::bowl(0.5, 0.4, 12)), test::plainTree(test::valley(15, 1, 0.3, 2, 2))})
      trees.push_back(withCorners(tree));
    return trees;
  }();
  return all;
}

KnownTree knownTreeFrom(Bytes& bytes) {
  if (bytes.below(2) == 0) return cloud(bytes);
  return solidTrees()[bytes.below(std::uint32_t(solidTrees().size()))];
}

std::shared_ptr<const SphereTree> damagedTreeFrom(Bytes& bytes) {
  SphereTreeData data = solidTrees()[bytes.below(std::uint32_t(solidTrees().size()))].tree->data();
  for (std::uint32_t i = 1 + bytes.below(4); i > 0; --i) damage(data, bytes);
  auto tree = SphereTree::create(std::move(data));
  if (tree) return std::make_shared<const SphereTree>(std::move(tree).value());
  requireSentence(tree.error().message);
  return {};
}

}  // namespace cairn::fuzz
