// SPDX-License-Identifier: Zlib
#include "queries/ray_query.h"

#include <algorithm>

#include "queries/leaf_walk.h"
#include "queries/query_frame.h"
#include "queries/seen_triangles.h"
#include "shape/bullet_math.h"
#include "shape/placed_triangle.h"

namespace cairn::bullet {

namespace {

// Bullet's test takes a triangle as larger: a hit may be outside it by 1e-4 in each barycentric coordinate, three of
// which move a point by at most twice the longest edge.
constexpr double kEdgeTolerance = 2e-4;
Vec3d inTree(const SphereTreeShape& shape, const btVector3& p) {
  return toVec3d(shape.bodyFromTree().invXform(p)) / double(shape.scale());
}

Segment segmentOf(const SphereTreeShape& shape, const btVector3& from, const btVector3& to) {
  const double slack = kEdgeTolerance * double(shape.size()) / double(shape.scale()) +
                       roundingSlack(shape, double(std::max(from.length(), to.length())));
  return {inTree(shape, from), inTree(shape, to), slack};
}

}  // namespace

void castRay(const SphereTreeShape& shape, btTriangleRaycastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const Segment segment = segmentOf(shape, callback.m_from, callback.m_to);
  if (!segment.isSane()) return;
  SeenTriangles seen(tree.triangles().size());
  walkLeaves(
      tree,
      [&](const Family& family, std::uint32_t living, float end) { return entriesOf(segment, family, living, end); },
      [&] { return segment.placeOf(double(callback.m_hitFraction)); },
      [&](NodeId leaf) {
        for (const std::uint32_t index : tree.regionTriangles(leaf)) {
          if (!seen.insert(index)) continue;
          PlacedTriangle triangle(shape, index);
          callback.processTriangle(triangle.corners, 0, static_cast<int>(index));
        }
      });
}

}  // namespace cairn::bullet
