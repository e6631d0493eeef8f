// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/mirror_match.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace cairn::builder {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFF;

Vec3d product(const Vec3d& a, const Vec3d& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Vertices in cells twice as wide as the tolerance.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vec3d>& vertices, double tolerance) : vertices_(vertices), tolerance_(tolerance) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) cells_[cellOf(vertices[v])].push_back(v);
  }
  /// The nearest vertex within the tolerance; the first of equals.
  std::uint32_t nearest(const Vec3d& point) const {
    std::uint32_t best = kNobody;
    double least = tolerance_;
    const Cell middle = cellOf(point);
    for (long long i = -1; i <= 1; ++i)
      for (long long j = -1; j <= 1; ++j)
        for (long long k = -1; k <= 1; ++k) {
          const auto cell = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (cell == cells_.end()) continue;
          for (const std::uint32_t v : cell->second)
            if (const double d = distance(vertices_[v], point); d < least || (d == least && best == kNobody)) {
              least = d;
              best = v;
            }
        }
    return best;
  }

 private:
  using Cell = std::array<long long, 3>;
  Cell cellOf(const Vec3d& p) const {
    const double width = 2 * tolerance_;
    return {std::llround(p.x / width), std::llround(p.y / width), std::llround(p.z / width)};
  }

  const std::vector<Vec3d>& vertices_;
  double tolerance_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// A triangle from its smallest index on, its direction kept.
Triangle fromSmallest(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<Triangle> sortedTriangles(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) t = fromSmallest(t);
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool boxesAgree(const TriangleMesh& mesh, const TriangleMesh& other, double tolerance) {
  const Bounds a = boundsOf(mesh), b = boundsOf(other);
  const double farthest = std::max({std::abs(a.lower.x), std::abs(a.lower.y), std::abs(a.lower.z), std::abs(a.upper.x),
                                    std::abs(a.upper.y), std::abs(a.upper.z)});
  // Farther out the cells of the grid have no whole numbers, and neighbours are not told apart by doubles.
  if (!(farthest < 0x1p50 * tolerance)) return false;
  return distance(a.lower, b.lower) <= 2 * tolerance && distance(a.upper, b.upper) <= 2 * tolerance;
}

/// The largest distance of two vertices that belong together; nothing where the meshes differ.
std::optional<double> deviationOf(const TriangleMesh& mesh, const TriangleMesh& image, double tolerance) {
  if (!boxesAgree(mesh, image, tolerance)) return std::nullopt;
  const VertexGrid grid(mesh.vertices, tolerance);
  std::vector<std::uint32_t> partner(image.vertices.size());
  std::vector<char> taken(mesh.vertices.size(), 0);
  double deviation = 0;
  for (std::size_t v = 0; v < partner.size(); ++v) {
    partner[v] = grid.nearest(image.vertices[v]);
    if (partner[v] == kNobody || std::exchange(taken[partner[v]], 1) != 0) return std::nullopt;
    deviation = std::max(deviation, distance(image.vertices[v], mesh.vertices[partner[v]]));
  }
  std::vector<Triangle> renamed = image.triangles;
  for (Triangle& t : renamed)
    for (std::uint32_t& v : t) v = partner[v];
  if (sortedTriangles(std::move(renamed)) != sortedTriangles(mesh.triangles)) return std::nullopt;
  return deviation;
}

}  // namespace

TriangleMesh mirrored(TriangleMesh mesh, const Vec3d& signs) {
  for (Vec3d& v : mesh.vertices) v = product(v, signs);
  if (signs.x * signs.y * signs.z < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

std::optional<MirrorMatch> mirrorMatch(const TriangleMesh& mesh, const TriangleMesh& other) {
  if (mesh.vertices.size() != other.vertices.size() || mesh.triangles.size() != other.triangles.size())
    return std::nullopt;
  const double tolerance = kMirrorMatchTolerance * boundsOf(mesh).diagonal();
  for (int count = 0; count <= 3; ++count)
    for (unsigned minus = 0; minus < 8; ++minus) {
      if (std::popcount(minus) != count) continue;
      const Vec3d signs{minus & 1 ? -1.0 : 1.0, minus & 2 ? -1.0 : 1.0, minus & 4 ? -1.0 : 1.0};
      const auto deviation = deviationOf(mesh, mirrored(other, signs), tolerance);
      if (deviation) return MirrorMatch{signs, *deviation};
    }
  return std::nullopt;
}

}  // namespace cairn::builder
