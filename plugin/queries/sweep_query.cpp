// SPDX-License-Identifier: Zlib
#include "queries/sweep_query.h"

#include <algorithm>
#include <vector>

#include "placement/placed_triangle.h"
#include "queries/convex_caster.h"
#include "queries/leaf_walk.h"
#include "queries/query_frame.h"
#include "queries/seen_triangles.h"

namespace cairn::bullet {

namespace {

struct Candidate {
  float at;
  std::uint32_t triangle;
};

float entryOf(const SweptBox& box, const SphereTree& tree, std::uint32_t triangle, float end) {
  const auto& corners = tree.triangles()[triangle];
  Vec3 lower = tree.vertices()[corners[0]], upper = lower;
  for (const std::uint32_t c : {corners[1], corners[2]})
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], tree.vertices()[c][axis]);
      upper[axis] = std::max(upper[axis], tree.vertices()[c][axis]);
    }
  return box.entryOf(lower, upper, end);
}

bool isEarlier(const Candidate& a, const Candidate& b) {
  return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
}

}  // namespace

bool castConvex(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleConvexcastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const SweptBox box = sweptBox(shape, callback, 0);
  if (!box.path().isSane()) return false;
  ConvexCaster caster(callback);
  SeenTriangles seen(tree.triangles().size());
  std::vector<Candidate> candidates;
  const auto end = [&] { return box.path().placeOf(double(caster.m_hitFraction)); };
  const auto entries = [&](const Family& family, std::uint32_t living, float until) {
    return box.entriesOf(family, living, until);
  };
  const auto gather = [&](std::uint32_t triangle) {
    if (!seen.insert(triangle)) return;
    const float at = entryOf(box, tree, triangle, end());
    if (at <= end()) candidates.push_back({at, triangle});
  };
  const auto castAtLeaf = [&](NodeId leaf) {
    candidates.clear();
    regions.visitTriangles(leaf, entries, end, gather);
    std::sort(candidates.begin(), candidates.end(), isEarlier);
    for (const Candidate& candidate : candidates) {
      if (candidate.at > end()) return;
      PlacedTriangle triangle(shape, candidate.triangle);
      caster.processTriangle(triangle.corners, 0, static_cast<int>(candidate.triangle));
    }
  };
  walkLeaves(
      tree,
      [&](std::uint32_t family, float until) { return entries(tree.family(family), tree.livingLanes(family), until); },
      end, castAtLeaf);
  return true;
}

}  // namespace cairn::bullet
