// SPDX-License-Identifier: Zlib
#include "queries/ray_query.h"

#include "queries/leaf_walk.h"
#include "queries/query_frame.h"
#include "queries/seen_triangles.h"
#include "shape/placed_triangle.h"

namespace cairn::bullet {

void castRay(const SphereTreeShape& shape, btTriangleRaycastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const Segment segment = segmentOf(shape, callback, edgeTolerance(shape));
  if (!segment.isSane()) return;
  SeenTriangles seen(tree.triangles().size());
  walkLeaves(
      tree,
      [&](std::uint32_t family, float end) {
        return entriesOf(segment, tree.family(family), tree.livingLanes(family), end);
      },
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
