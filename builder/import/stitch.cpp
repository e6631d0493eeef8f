// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/stitch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "import/bodies.h"
#include "import/border.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

std::vector<std::uint32_t> verticesOf(const std::vector<HalfEdge>& edges) {
  std::vector<std::uint32_t> vertices;
  for (const HalfEdge& e : edges) vertices.insert(vertices.end(), {e.from, e.to});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// For every vertex: the lowest-numbered border vertex that can be reached from it in steps of at most `tolerance`;
/// itself without any.
std::vector<std::uint32_t> nearbyVertices(const TriangleMesh& mesh, double tolerance) {
  std::vector<std::uint32_t> leader(mesh.vertices.size());
  std::iota(leader.begin(), leader.end(), 0U);
  const auto leaderOf = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  using Cell = std::array<std::int64_t, 3>;
  const Vec3d lower = boundsOf(mesh).lower;
  std::map<Cell, std::vector<std::uint32_t>> grid;  // cells as wide as the tolerance
  for (const std::uint32_t v : verticesOf(borderEdges(mesh))) {
    const Vec3d place = (mesh.vertices[v] - lower) * (1 / tolerance);
    const Cell cell{std::llround(place.x), std::llround(place.y), std::llround(place.z)};
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const auto found =
          grid.find({cell[0] + neighbour % 3 - 1, cell[1] + neighbour / 3 % 3 - 1, cell[2] + neighbour / 9 - 1});
      if (found == grid.end()) continue;
      for (const std::uint32_t other : found->second) {
        if (length(mesh.vertices[v] - mesh.vertices[other]) > tolerance) continue;
        const auto [low, high] = std::minmax({leaderOf(v), leaderOf(other)});
        leader[high] = low;
      }
    }
    grid[cell].push_back(v);
  }
  for (std::uint32_t v = 0; v < leader.size(); ++v) leader[v] = leaderOf(v);
  return leader;
}

bool hasArea(const TriangleMesh& mesh, const Triangle& t) {
  return !isDegenerate({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

/// Border vertices sorted along one axis, to find those near an edge.
class BorderVertices {
 public:
  BorderVertices(const TriangleMesh& mesh, const std::vector<HalfEdge>& border)
      : mesh_(mesh), vertices_(verticesOf(border)) {
    const Bounds bounds = boundsOf(mesh);
    const Vec3d size = bounds.upper - bounds.lower;
    axis_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::sort(vertices_.begin(), vertices_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(at(a), a) < std::pair(at(b), b); });
  }

  /// The border vertices within `tolerance` of the inside of an edge, in order from its start; never the triangle's
  /// third corner.
  std::vector<std::uint32_t> on(const HalfEdge& edge, double tolerance) const {
    const Vec3d from = mesh_.vertices[edge.from], along = mesh_.vertices[edge.to] - from;
    const double reach = length(along);
    const auto [low, high] = std::minmax({at(edge.from), at(edge.to)});
    std::vector<std::pair<double, std::uint32_t>> found;
    const auto first = std::lower_bound(vertices_.begin(), vertices_.end(), low - tolerance,
                                        [&](std::uint32_t v, double value) { return at(v) < value; });
    for (auto v = first; v != vertices_.end() && at(*v) <= high + tolerance; ++v) {
      const Vec3d offset = mesh_.vertices[*v] - from;
      const double position = dot(offset, along) / reach;
      if (position <= tolerance || position >= reach - tolerance) continue;
      if (length(offset - along * (position / reach)) > tolerance) continue;
      const Triangle& t = mesh_.triangles[edge.triangle];
      if (std::find(t.begin(), t.end(), *v) == t.end()) found.emplace_back(position, *v);
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> order;
    for (const auto& [position, v] : found) order.push_back(v);
    return order;
  }

 private:
  double at(std::uint32_t v) const { return mesh_.vertices[v][axis_]; }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> vertices_;
  int axis_ = 0;
};

/// Replaces the triangle by a fan from the corner opposite to `edge`, over the edge and the vertices on it. False,
/// without any change, when a part of it would have no area.
bool splitEdge(TriangleMesh& mesh, const HalfEdge& edge, const std::vector<std::uint32_t>& on) {
  const std::uint32_t apex = mesh.triangles[edge.triangle][(edge.side + 2) % 3];
  std::vector<Triangle> fan;
  std::uint32_t from = edge.from;
  for (const std::uint32_t v : on) fan.push_back({std::exchange(from, v), v, apex});
  fan.push_back({from, edge.to, apex});
  if (!std::all_of(fan.begin(), fan.end(), [&](const Triangle& t) { return hasArea(mesh, t); })) return false;
  mesh.triangles[edge.triangle] = fan.front();
  mesh.triangles.insert(mesh.triangles.end(), fan.begin() + 1, fan.end());
  return true;
}

/// Splits one edge of a triangle at a time, because the other edges move into its parts. Returns the number of split
/// triangles.
std::size_t splitOnce(TriangleMesh& mesh, double tolerance) {
  const std::vector<HalfEdge> border = borderEdges(mesh);
  const BorderVertices vertices(mesh, border);
  std::set<std::uint32_t> done;
  std::vector<std::pair<HalfEdge, std::vector<std::uint32_t>>> work;
  for (const HalfEdge& edge : border) {
    std::vector<std::uint32_t> on = vertices.on(edge, tolerance);
    if (!on.empty() && done.insert(edge.triangle).second) work.emplace_back(edge, std::move(on));
  }
  std::size_t split = 0;
  for (const auto& [edge, on] : work) split += splitEdge(mesh, edge, on);
  return split;
}

/// Drops every triangle with the same key as an earlier one. Returns their number.
template <class Key>
std::size_t dropRepeated(TriangleMesh& mesh, const Key& keyOf) {
  std::set<Triangle> seen;
  return std::erase_if(mesh.triangles, [&](const Triangle& t) { return !seen.insert(keyOf(t)).second; });
}

}  // namespace

void dropDuplicates(TriangleMesh& mesh, RepairCounts& counts) {
  TriangleMesh thinned = mesh;
  std::size_t dropped = dropRepeated(thinned, [](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  });
  const bool isBalancedAsItIs = isBalanced(mesh);
  if (isBalancedAsItIs && !isBalanced(thinned)) return;  // bodies that share a face
  if (!isBalancedAsItIs && !isBalanced(thinned))
    dropped += dropRepeated(thinned, [](Triangle t) {
      std::sort(t.begin(), t.end());
      return t;
    });
  counts.duplicateTriangles += dropped;
  mesh = std::move(thinned);
}

void joinBorders(TriangleMesh& mesh, double tolerance, RepairCounts& counts) {
  const std::vector<std::uint32_t> leader = nearbyVertices(mesh, tolerance);
  for (std::uint32_t v = 0; v < leader.size(); ++v) counts.joinedVertices += leader[v] != v;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = leader[v];
  }
  counts.collapsedTriangles += std::erase_if(mesh.triangles, [&](const Triangle& t) { return !hasArea(mesh, t); });
}

void splitAtBorderVertices(TriangleMesh& mesh, double tolerance, RepairCounts& counts) {
  // Every round shortens border edges that have vertices on them; three sides of a triangle take three rounds.
  constexpr int kMaxRounds = 8;
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t split = splitOnce(mesh, tolerance);
    counts.splitTriangles += split;
    if (split == 0) return;
  }
}

}  // namespace cairn::builder
