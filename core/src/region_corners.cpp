// SPDX-License-Identifier: Zlib
// What a coarse leaf's support points leave out of its region.
#include <algorithm>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn {

namespace {

// A closed surface has twice as many triangles as vertices, and a region a border besides: no more than so many are
// looked through to find that there are too many corners.
constexpr std::uint32_t kMaxTriangles = 4 * kMaxRegionCorners;
// A corner may be what its ball was made for: an ulp or two of the lengths must not lose it.
constexpr float kRounding = 1 + 0x1p-20F;
// The name of none.
constexpr NodeId kNoLeaf = ~NodeId{0};

}  // namespace

bool SphereTree::mayListCorners(NodeId id) const {
  return isLeaf(id) && node(id).triangleCount <= kMaxTriangles;
}

// Builders stop choosing support points where few suffice along the directions they look along, so few say nothing.
bool SphereTree::areSupportPoints(std::span<const std::uint32_t> corners, NodeId id) const {
  const std::span<const Vec3> points = supportPoints(id);
  return std::ranges::all_of(
      corners, [&](std::uint32_t v) { return std::ranges::find(points, data_.vertices[v]) != points.end(); });
}

// Every node's list in the order of their names, each corner once: `seenIn` names the last leaf that listed it.
void SphereTree::listCorners() {
  const std::size_t slots = traversalNodes_.size();
  std::vector<NodeId> seenIn(data_.vertices.size(), kNoLeaf);
  firstCorner_.assign(slots + 1, 0);
  for (NodeId id = 0; id < slots; ++id) {
    const std::size_t first = corners_.size();
    firstCorner_[id] = static_cast<std::uint32_t>(first);
    if (recordIndex_[id] >= nodeCount() || !mayListCorners(id)) continue;
    const Sphere ball = sphere(id);
    for (const std::uint32_t triangle : regionTriangles(id))
      for (const std::uint32_t v : data_.triangles[triangle]) {
        if (seenIn[v] == id || distance(data_.vertices[v], ball.center) > kRounding * ball.radius) continue;
        seenIn[v] = id;
        corners_.push_back(v);
      }
    const std::span<const std::uint32_t> listed = std::span(corners_).subspan(first);
    if (listed.size() > kMaxRegionCorners || areSupportPoints(listed, id)) corners_.resize(first);
  }
  firstCorner_[slots] = static_cast<std::uint32_t>(corners_.size());
}

}  // namespace cairn
