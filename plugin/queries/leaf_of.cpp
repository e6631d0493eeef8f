// SPDX-License-Identifier: Zlib
#include <algorithm>
#include <limits>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "placement/bullet_math.h"
#include "queries/query_frame.h"

namespace cairn::bullet {

std::optional<NodeId> SphereTreeShape::leafOf(int triangle, const btVector3& point) const {
  const Vec3 p(pointInTree(*this, point));
  const float slack = static_cast<float>(edgeTolerance(*this) + roundingSlack(*this, double(point.length())));
  const auto holds = [&](NodeId node) {
    return distance(p, tree_->sphere(node).center) <= tree_->sphere(node).radius + slack;
  };
  std::optional<NodeId> best;
  float nearest = std::numeric_limits<float>::max();
  std::vector<NodeId> stack = {kRootNode};
  while (!stack.empty()) {
    const NodeId node = stack.back();
    stack.pop_back();
    if (!holds(node)) continue;
    if (!tree_->isLeaf(node)) {
      const std::uint32_t family = tree_->childFamily(node);
      for (std::uint32_t lane = 0; lane < tree_->familySize(family); ++lane)
        stack.push_back(family * kFamilyWidth + lane);
      continue;
    }
    const auto region = tree_->regionTriangles(node);
    const float away = distance(p, tree_->sphere(node).center);
    if (away >= nearest ||
        std::find(region.begin(), region.end(), static_cast<std::uint32_t>(triangle)) == region.end())
      continue;
    nearest = away;
    best = node;
  }
  return best;
}

}  // namespace cairn::bullet
