// SPDX-License-Identifier: Zlib
#include "queries/ray_query.h"

#include "placement/placed_triangle.h"
#include "queries/leaf_walk.h"
#include "queries/query_frame.h"
#include "queries/seen_triangles.h"

namespace cairn::bullet {

void castRay(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleRaycastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const Segment segment = segmentOf(shape, callback, edgeTolerance(shape));
  if (!segment.isSane()) return;
  SeenTriangles seen(tree.triangles().size());
  const auto entries = [&](const Family& family, std::uint32_t living, float end) {
    return entriesOf(segment, family, living, end);
  };
  const auto end = [&] { return segment.placeOf(double(callback.m_hitFraction)); };
  const auto ask = [&](std::uint32_t index) {
    if (!seen.insert(index)) return;
    PlacedTriangle triangle(shape, index);
    callback.processTriangle(triangle.corners, 0, static_cast<int>(index));
  };
  walkLeaves(
      tree,
      [&](std::uint32_t family, float until) { return entries(tree.family(family), tree.livingLanes(family), until); },
      end, [&](NodeId leaf) { regions.visitTriangles(leaf, entries, end, ask); });
}

}  // namespace cairn::bullet
