// SPDX-License-Identifier: Zlib
#include "tree_views.h"

#include <algorithm>

namespace cairn::wasm {

namespace {

void append(const Vec3& inTree, const Vec3d& origin, std::vector<float>& list) {
  list.insert(list.end(), {float(double(inTree.x) + origin.x), float(double(inTree.y) + origin.y),
                           float(double(inTree.z) + origin.z)});
}

}  // namespace

Result<SphereTree> cutBelow(const SphereTree& tree, int depth) {
  if (depth < 1) return Error{"a tree cannot be cut below level " + std::to_string(depth) + "; give a level from 1 on"};
  SphereTreeData data = tree.data();
  const auto isDeeper = [&](std::uint32_t record) {
    return tree.level(tree.nodeAt(record)) > static_cast<std::uint32_t>(depth);
  };
  // Nodes are stored breadth-first, so what stays comes first.
  std::size_t kept = 0;
  while (kept < data.nodes.size() && !isDeeper(static_cast<std::uint32_t>(kept))) ++kept;
  data.nodes.resize(kept);
  if (!data.bounds.empty()) data.bounds.resize(kept);
  return SphereTree::create(std::move(data));
}

std::vector<double> numbersOf(const SphereTree& tree) {
  const MassProperties& mass = tree.mass();
  std::vector<double> list{double(tree.depth()),          double(tree.nodeCount()),   double(tree.leafCount()),
                           double(tree.levelMeshCount()), double(tree.memoryBytes()), mass.volume,
                           mass.centerOfMass.x,           mass.centerOfMass.y,        mass.centerOfMass.z};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) list.push_back(mass.inertia(row, column));
  return list;
}

std::vector<float> meshVertices(const SphereTree& tree) {
  std::vector<float> list;
  list.reserve(3 * tree.vertices().size());
  for (const Vec3& vertex : tree.vertices()) append(vertex, tree.origin(), list);
  return list;
}

std::vector<std::uint32_t> meshTriangles(const SphereTree& tree) {
  std::vector<std::uint32_t> list;
  list.reserve(3 * tree.triangles().size());
  for (const auto& triangle : tree.triangles()) list.insert(list.end(), triangle.begin(), triangle.end());
  return list;
}

std::vector<float> spheresOf(const SphereTree& tree, std::uint32_t level) {
  std::vector<float> list;
  for (const NodeId node : tree.levelCut(level)) {
    append(tree.sphere(node).center, tree.origin(), list);
    list.insert(list.end(), {tree.sphere(node).radius, tree.error(node)});
  }
  return list;
}

}  // namespace cairn::wasm
