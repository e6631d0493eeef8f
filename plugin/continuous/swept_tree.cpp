// SPDX-License-Identifier: Zlib
#include "continuous/swept_tree.h"

#include <cmath>

#include "cairn/bullet/sphere_tree_shape.h"
#include "continuous/swept_triangle.h"
#include "placement/tree_pose.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

void SweptTree::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  const SphereTreeShape& tree = *asSphereTree(&shape);
  tree_ = TreeParts(PlacedTree(tree.tree(), treePose(tree, btTransform::getIdentity())));
  margin_ = static_cast<float>(tree.getMargin());
}

SweptTarget::Children SweptTree::children(std::uint32_t element, float crude) const {
  const TreeParts::Children below = tree_.children(element, crude);
  return {below.first, below.count};
}

// Two moving spheres: the time when the line of centre differences first comes within the sum of radii.
std::optional<float> SweptTree::entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const {
  if (TreeParts::isTriangle(element))
    return SweptTriangle(tree_.triangle(element)).entry({ball.center, ball.radius + margin_}, displacement);
  const Sphere own = tree_.sphere(element);
  const Vec3 from = ball.center - own.center;
  const float radius = ball.radius + own.radius + margin_;
  const float beyond = lengthSq(from) - radius * radius;
  if (beyond <= 0) return 0.0F;
  const float along = -dot(from, displacement), displacementSq = lengthSq(displacement);
  if (along <= 0) return std::nullopt;
  const float root = along * along - displacementSq * beyond;
  if (root < 0) return std::nullopt;
  const float at = beyond / (along + std::sqrt(root));
  if (at > 1) return std::nullopt;
  return at;
}

void SweptTree::appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) {
  if (TreeParts::isTriangle(element)) return SweptTriangle(tree_.triangle(element)).appendNormals(center, normals);
  const Vec3 line = center - tree_.sphere(element).center;
  if (line != Vec3()) normals.add(unitVector(line), false);
  tree_.appendFaces(element, normals);
}

void SweptTree::name(std::uint32_t element, Contact& contact) const {
  const NodeId node = TreeParts::nodeOf(element);
  contact.id.otherPart = static_cast<int>(tree_.tree().level(node));
  contact.id.otherIndex = static_cast<int>(node);
  contact.pair.b = node;
}

}  // namespace cairn::bullet
