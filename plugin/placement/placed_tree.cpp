// SPDX-License-Identifier: Zlib
#include "placement/placed_tree.h"

#include <limits>

#include "placement/bullet_math.h"

namespace cairn::bullet {

PlacedTree::PlacedTree(const SphereTree& tree, const Pose& pose, std::uint32_t contactLevel)
    : tree_(&tree), contactLevel_(contactLevel), pose_(pose), toPair_(toSimilarity(pose)) {
  const Mat3d inverse = transpose(pose.rotation);
  axesFromPair_ = {{Vec3(inverse.rows[0]), Vec3(inverse.rows[1]), Vec3(inverse.rows[2])}};
}

Vec3 PlacedTree::certainReach(NodeId node, const Vec3& direction) const {
  return certainReach(node, direction, support(node, direction));
}

Vec3 PlacedTree::farthestCorner(NodeId node, const Vec3& direction) const {
  const std::span<const std::uint32_t> corners = tree_->regionCorners(node);
  const Vec3 point = support(node, direction);
  return corners.empty() ? point : farthestOf(corners, direction, point);
}

Vec3 PlacedTree::extreme(NodeId node, const Vec3& direction) const {
  return certainReach(node, direction, farthestCorner(node, direction));
}

Vec3 PlacedTree::certainReach(NodeId node, const Vec3& direction, const Vec3& point) const {
  const Sphere ball = sphere(node);
  const float out = ball.radius - tree_->error(node) * scale();
  return dot(direction, point - ball.center) < out ? ball.center + direction * out : point;
}

Vec3 PlacedTree::farthestOf(std::span<const std::uint32_t> corners, const Vec3& direction, const Vec3& point) const {
  const Vec3 along = axesFromPair_ * direction;
  const std::span<const Vec3> vertices = tree_->vertices();
  float farthest = std::numeric_limits<float>::lowest();
  std::uint32_t corner = corners.front();
  for (const std::uint32_t v : corners) {
    const float projection = dot(along, vertices[v]);
    if (projection <= farthest) continue;
    farthest = projection;
    corner = v;
  }
  const Vec3 there = toPair_ * vertices[corner];
  return dot(direction, there) > dot(direction, point) ? there : point;
}

NodeId PlacedTree::leafAt(const Vec3& point) const {
  const Vec3 here = toTree(point);
  const auto outside = [&](NodeId node) {
    const Sphere ball = tree_->sphere(node);
    return distance(ball.center, here) - ball.radius;
  };
  NodeId node = kRootNode;
  while (!tree_->isLeaf(node)) {
    const NodeId first = tree_->childFamily(node) * kFamilyWidth, count = tree_->childCount(node);
    node = first;
    for (NodeId child = first + 1; child < first + count; ++child)
      if (outside(child) < outside(node)) node = child;
  }
  return node;
}

}  // namespace cairn::bullet
