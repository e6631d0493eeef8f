// SPDX-License-Identifier: Zlib
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "placement/bullet_math.h"
#include "placement/placed_triangle.h"
#include "queries/cast.h"

namespace cairn::bullet {

namespace {

struct TriangleBounds {
  Vec3 lower, upper;
};

float distanceSq(const TriangleBounds& box, const Vec3& p) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float outside = std::max({box.lower[axis] - p[axis], 0.0F, p[axis] - box.upper[axis]});
    sum += outside * outside;
  }
  return sum;
}

bool meets(const SphereTree& tree, NodeId node, const TriangleBounds& box) {
  const Sphere s = tree.sphere(node);
  const float reach = s.radius * (1 + kOverlapSlack) + tree.extent() * kOverlapSlack;
  return distanceSq(box, s.center) <= reach * reach;
}

// The triangles of all leaves near the box, each once, ascending.
std::vector<std::uint32_t> trianglesNear(const SphereTree& tree, const TriangleBounds& box) {
  std::vector<std::uint32_t> found;
  std::vector<NodeId> stack = {kRootNode};
  while (!stack.empty()) {
    const NodeId node = stack.back();
    stack.pop_back();
    if (!meets(tree, node, box)) continue;
    if (tree.isLeaf(node)) {
      const auto region = tree.regionTriangles(node);
      found.insert(found.end(), region.begin(), region.end());
      continue;
    }
    const std::uint32_t family = tree.childFamily(node);
    for (std::uint32_t lane = 0; lane < tree.familySize(family); ++lane) stack.push_back(family * kFamilyWidth + lane);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// The box (body's frame) as a box in the tree's frame and unit. First it is cut to more than the body can fill, because
// rotating an infinite box (debug drawing) gives NaN. Then it is grown by the rounding of its lengths.
TriangleBounds toTreeFrame(const SphereTreeShape& shape, const btVector3& aabbMin, const btVector3& aabbMax) {
  const btScalar limit =
      2 * (btScalar(shape.tree().extent()) * shape.scale() + shape.bodyFromTree().getOrigin().length());
  const btVector3 most(limit, limit, limit);
  btVector3 cutMin = aabbMin, cutMax = aabbMax, lower, upper;
  cutMin.setMax(-most);
  cutMin.setMin(most);
  cutMax.setMin(most);
  cutMax.setMax(-most);
  btTransformAabb(cutMin, cutMax, btScalar(kOverlapSlack) * limit, shape.bodyFromTree().inverse(), lower, upper);
  return {toVec3(lower / shape.scale()), toVec3(upper / shape.scale())};
}

}  // namespace

void SphereTreeShape::processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                                          const btVector3& aabbMax) const {
  if (answerCast(*this, *regionBalls_, leafBalls_.get(), *callback)) return;
  for (const std::uint32_t index : trianglesNear(*tree_, toTreeFrame(*this, aabbMin, aabbMax))) {
    PlacedTriangle triangle(*this, index);
    if (TestTriangleAgainstAabb2(triangle.corners, aabbMin, aabbMax))
      callback->processTriangle(triangle.corners, 0, static_cast<int>(index));
  }
}

}  // namespace cairn::bullet
