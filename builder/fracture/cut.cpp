// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/cut.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fracture/cap.h"
#include "fracture/parts.h"
#include "fracture/slivers.h"

namespace cairn::builder {
namespace {

// One plane through one mesh.
class Cut {
 public:
  Cut(TriangleMesh& mesh, const HalfSpace& space) : mesh_(mesh), space_(space) {
    for (const Vec3d& v : mesh.vertices) heights_.push_back(space.heightOf(v));
  }

  Status run() {
    const std::vector<Triangle> all = std::exchange(mesh_.triangles, {});
    for (const Triangle& t : all) keepBelow(t);
    if (border_.empty()) return {};
    auto cap = capOf(mesh_.vertices, border_, space_);
    if (!cap) return cap.error();
    mesh_.triangles.insert(mesh_.triangles.end(), cap.value().begin(), cap.value().end());
    return {};
  }

 private:
  bool isBelow(std::uint32_t v) const { return heights_[v] <= 0; }

  // The crossing of an edge from a vertex below to one above; both triangles of the edge share it.
  std::uint32_t crossing(std::uint32_t below, std::uint32_t above) {
    const auto [at, isNew] = crossings_.try_emplace({below, above}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (isNew) {
      const double part = heights_[below] / (heights_[below] - heights_[above]);
      mesh_.vertices.push_back(mesh_.vertices[below] + (mesh_.vertices[above] - mesh_.vertices[below]) * part);
    }
    return at->second;
  }

  void keepBelow(const Triangle& t) {
    const auto below = std::ranges::count_if(t, [&](std::uint32_t v) { return isBelow(v); });
    if (below == 3) mesh_.triangles.push_back(t);
    if (below == 0 || below == 3) return;
    int first = 0;  // the vertex that is alone on its side
    while (isBelow(t[first]) != (below == 1)) ++first;
    const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    if (below == 1) {
      const std::uint32_t ab = crossing(a, b), ac = crossing(a, c);
      mesh_.triangles.push_back({a, ab, ac});
      border_.push_back({ac, ab});
    } else {
      const std::uint32_t ba = crossing(b, a), ca = crossing(c, a);
      mesh_.triangles.push_back({ba, b, c});
      mesh_.triangles.push_back({ba, c, ca});
      border_.push_back({ba, ca});
    }
  }

  TriangleMesh& mesh_;
  const HalfSpace& space_;
  std::vector<double> heights_;  // of the original vertices
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
  std::vector<BorderEdge> border_;
};

}  // namespace

Result<std::vector<TriangleMesh>> cut(const TriangleMesh& solid, std::span<const HalfSpace> spaces) {
  // Corners round by less than this.
  const double tolerance = 1e-12 * boundsOf(solid).diagonal();
  TriangleMesh mesh{solid.vertices, solid.triangles, {}, {}};
  for (const HalfSpace& space : spaces) {
    if (const Status done = Cut(mesh, space).run(); !done) return done.error();
    mesh = withoutSlivers(mesh, tolerance);
  }
  return partsOf(mesh);
}

}  // namespace cairn::builder
