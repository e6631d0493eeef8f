// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/weld.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace cairn::builder {

bool isDegenerate(const std::array<Vec3d, 3>& corners) {
  const Vec3d ab = corners[1] - corners[0], ac = corners[2] - corners[0], bc = corners[2] - corners[1];
  // A cross product of two edges rounds by less than 4 units of the product of their lengths; below that there is no
  // normal.
  constexpr double kUnits = 4 * std::numeric_limits<double>::epsilon();
  const double longest = std::max({lengthSq(ab), lengthSq(ac), lengthSq(bc)});
  return !(length(cross(ab, ac)) > kUnits * longest);
}

TriangleMesh weld(const TriangleSoup& soup, ImportCounts& counts) {
  const auto position = [&](std::uint32_t corner) -> const Vec3d& { return soup[corner / 3][corner % 3]; };
  std::vector<std::uint32_t> order(soup.size() * 3);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3d &p = position(a), &q = position(b);
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::vector<std::uint32_t> representative(order.size());  // the first corner of the file at the same position
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && position(order[i]) == position(order[i - 1]);
    representative[order[i]] = same ? representative[order[i - 1]] : order[i];
  }

  TriangleMesh mesh;
  constexpr std::uint32_t kUnnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(order.size(), kUnnumbered);
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    if (isDegenerate(soup[t])) {
      ++counts.degenerateTriangles;
      continue;
    }
    Triangle triangle{};
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t& vertex = number[representative[3 * t + i]];
      if (vertex == kUnnumbered) {
        vertex = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(position(3 * t + i));
      }
      triangle[i] = vertex;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace cairn::builder
