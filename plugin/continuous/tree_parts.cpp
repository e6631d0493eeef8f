// SPDX-License-Identifier: Zlib
#include "continuous/tree_parts.h"

#include <algorithm>

namespace cairn::bullet {

bool TreeParts::isCrude(NodeId leaf, float crude) const {
  if (tree_.tree().error(leaf) * scale() <= crude || tree_.isPlanar(leaf) || tree_.isFaceted(leaf)) return false;
  return tree_.tree().regionTriangles(leaf).size() <= kMaxTriangles && leaf < kTriangleBit / kMaxTriangles;
}

TreeParts::Children TreeParts::children(Part part, float crude) const {
  if (isTriangle(part)) return {};
  if (!tree().isLeaf(part)) return {tree().childFamily(part) * kFamilyWidth, tree().childCount(part)};
  if (!isCrude(part, crude)) return {};
  return {kTriangleBit | part * kMaxTriangles, static_cast<std::uint32_t>(tree().regionTriangles(part).size())};
}

Triangle TreeParts::triangle(Part part) const {
  const SphereTreeData& data = tree().data();
  const auto& [a, b, c] = data.triangles[tree().regionTriangles(nodeOf(part))[indexOf(part)]];
  return {tree_.toPair() * data.vertices[a], tree_.toPair() * data.vertices[b], tree_.toPair() * data.vertices[c]};
}

// Centred at the mean of a triangle's corners, which rotates with them; the centre of a box would not.
Sphere TreeParts::sphere(Part part) const {
  if (!isTriangle(part)) return tree_.sphere(part);
  const auto& [a, b, c] = triangle(part);
  const Vec3 middle = (a + b + c) / 3;
  return {middle, std::max({distance(middle, a), distance(middle, b), distance(middle, c)})};
}

Vec3 TreeParts::support(Part part, const Vec3& direction) const {
  return isTriangle(part) ? supportOf(triangle(part), direction) : tree_.support(part, direction);
}

void TreeParts::appendFaces(Part part, SeparatingNormals& normals) const {
  const auto add = [&](const Vec3& normal) {
    normals.add(normal, true);
    normals.add(-normal, true);
  };
  if (isTriangle(part)) {
    add(triangle(part).normal());
  } else if (tree_.isFaceted(part)) {
    const Mat3 fromTree = transpose(tree_.axesFromPair());
    for (const Vec3& face : tree().faceNormals(part)) add(fromTree * face);
  } else if (tree_.isPlanar(part)) {
    add(tree_.facing(part));
  }
}

}  // namespace cairn::bullet
