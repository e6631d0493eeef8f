// SPDX-License-Identifier: Zlib
#include "continuous/swept_tree.h"

#include <cmath>

#include "cairn/bullet/sphere_tree_shape.h"
#include "placement/tree_pose.h"

namespace cairn::bullet {

void appendFaces(const PlacedTree& tree, NodeId node, SeparatingNormals& normals) {
  const auto add = [&](const Vec3& normal) {
    normals.add(normal, true);
    normals.add(-normal, true);
  };
  if (tree.isFaceted(node)) {
    const Mat3 fromTree = transpose(tree.axesFromPair());
    for (const Vec3& face : tree.tree().faceNormals(node)) add(fromTree * face);
  } else if (tree.isPlanar(node)) {
    add(tree.facing(node));
  }
}

void SweptTree::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  const SphereTreeShape& tree = *asSphereTree(&shape);
  tree_ = PlacedTree(tree.tree(), treePose(tree, btTransform::getIdentity()));
  margin_ = static_cast<float>(tree.getMargin());
}

SweptTarget::Children SweptTree::children(std::uint32_t element) const {
  return {tree_.tree().childFamily(element) * kFamilyWidth, tree_.tree().childCount(element)};
}

// Two moving spheres: where the line through the centres' difference first comes as near as their radii.
std::optional<float> SweptTree::entry(const Sphere& ball, std::uint32_t element, const Vec3& way) const {
  const Sphere own = tree_.sphere(element);
  const Vec3 from = ball.center - own.center;
  const float radius = ball.radius + own.radius + margin_;
  const float beyond = lengthSq(from) - radius * radius;
  if (beyond <= 0) return 0.0F;
  const float along = -dot(from, way), waySq = lengthSq(way);
  if (along <= 0) return std::nullopt;
  const float root = along * along - waySq * beyond;
  if (root < 0) return std::nullopt;
  const float at = beyond / (along + std::sqrt(root));
  if (at > 1) return std::nullopt;
  return at;
}

void SweptTree::appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) {
  const Vec3 line = center - tree_.sphere(element).center;
  if (lengthSq(line) > 0) normals.add(normalized(line), false);
  appendFaces(tree_, element, normals);
}

void SweptTree::name(std::uint32_t element, ContactId& id) const {
  id.otherPart = static_cast<int>(tree_.tree().level(element));
  id.otherIndex = static_cast<int>(element);
}

}  // namespace cairn::bullet
