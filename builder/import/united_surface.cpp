// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/united_surface.h"

#include <CGAL/Bbox_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "import/arrangement.h"
#include "import/one_line.h"

namespace cairn::builder {
namespace {

using Kernel = Arrangement::Kernel;
using Point = Kernel::Point_3;

/// Numbers of bodies, but for those that are zero.
using Counts = std::vector<std::pair<std::uint32_t, int>>;

void add(Counts& counts, std::uint32_t body, int number) {
  auto found = std::ranges::find(counts, body, &Counts::value_type::first);
  if (found == counts.end()) found = counts.insert(counts.end(), {body, 0});
  found->second += number;
  if (found->second == 0) counts.erase(found);
}

Counts sum(Counts a, const Counts& b) {
  for (const auto& [body, number] : b) add(a, body, number);
  return a;
}

/// Triangles of an arrangement with the same three vertices, as one.
struct Sheet {
  Triangle corners{};
  std::uint32_t source = 0;
  Counts layers;  ///< for each body: how many more of them face this way than the other
};

/// The same corners, the smallest first, and the way they turn.
std::pair<Triangle, int> canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  if (t[1] < t[2]) return {t, 1};
  std::swap(t[1], t[2]);
  return {t, -1};
}

/// Sheets that are crossed at all, in the order of their first triangles. They face as most layers of their first body
/// do, and so alike on both sides of an edge of two sheets.
std::vector<Sheet> sheetsOf(const Arrangement& arrangement, const std::vector<std::uint32_t>& bodies) {
  std::vector<Sheet> sheets;
  std::map<Triangle, std::size_t> numbers;
  for (std::size_t t = 0; t < arrangement.triangles.size(); ++t) {
    const auto [corners, turn] = canonical(arrangement.triangles[t]);
    const auto [found, isNew] = numbers.emplace(corners, sheets.size());
    if (isNew) sheets.push_back({corners, arrangement.source[t], {}});
    add(sheets[found->second].layers, bodies[arrangement.source[t]], turn);
  }
  std::erase_if(sheets, [](const Sheet& s) { return s.layers.empty(); });
  for (Sheet& s : sheets) {
    if (std::ranges::min(s.layers).second > 0) continue;
    std::swap(s.corners[1], s.corners[2]);
    for (auto& [body, number] : s.layers) number = -number;
  }
  return sheets;
}

/// For each sheet: the first one of its patch. Sheets of a patch are connected by edges of two sheets, so the same lies
/// on their sides.
std::vector<std::size_t> patchesOf(const std::vector<Sheet>& sheets) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> edges;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    for (std::size_t i = 0; i < 3; ++i)
      edges[std::minmax({sheets[s].corners[i], sheets[s].corners[(i + 1) % 3]})].push_back(s);
  std::vector<std::size_t> parent(sheets.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t s) {
    while (parent[s] != s) s = parent[s] = parent[parent[s]];
    return s;
  };
  for (const auto& [edge, beside] : edges) {
    if (beside.size() != 2) continue;
    const auto [low, high] = std::minmax({root(beside[0]), root(beside[1])});
    parent[high] = low;
  }
  for (std::size_t s = 0; s < parent.size(); ++s) parent[s] = root(s);
  return parent;
}

/// Exact winding numbers of the bodies of a mesh.
class Winding {
 public:
  Winding(const TriangleMesh& mesh, const std::vector<Point>& points, const std::vector<std::uint32_t>& bodies)
      : mesh_(mesh), points_(points), bodies_(bodies) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      CGAL::Bbox_3 box;
      for (const std::uint32_t v : mesh.triangles[t]) box += points[v].bbox();
      boxes_.push_back(box);
      all_ += box;
    }
  }

  /// How often each body winds around the points in front of a sheet.
  Counts inFrontOf(const Sheet& sheet) {
    const Point &a = points_[sheet.corners[0]], &b = points_[sheet.corners[1]], &c = points_[sheet.corners[2]];
    const Point from = CGAL::centroid(a, b, c);
    const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
    for (;;) {  // a ray through an edge does not count; nearly none do
      const Kernel::Vector_3 along = direction();
      const CGAL::Sign side = CGAL::sign(along * normal);
      if (side == CGAL::ZERO) continue;
      const Point to = side == CGAL::POSITIVE ? from + along : from - along;
      if (std::optional<Counts> counts = crossings(from, to)) return *std::move(counts);
    }
  }

 private:
  /// Longer than the mesh, and nearly along an axis, so that few boxes are near.
  Kernel::Vector_3 direction() {
    const double reach = 4 * std::max({all_.x_span(), all_.y_span(), all_.z_span()});
    const auto slant = [&] { return reach * (static_cast<double>(engine_() >> 12) * 0x1p-52 - 0.5) / 64; };
    const double y = slant(), z = slant();
    return {reach, y, z};
  }

  /// Triangles of each body that the line passes outward, less those it passes inward; nothing when it meets an edge.
  std::optional<Counts> crossings(const Point& from, const Point& to) const {
    const CGAL::Bbox_3 reach = from.bbox() + to.bbox();
    Counts counts;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!CGAL::do_overlap(reach, boxes_[t])) continue;
      const auto& [i, j, k] = mesh_.triangles[t];
      const Point &a = points_[i], &b = points_[j], &c = points_[k];
      const CGAL::Sign start = CGAL::orientation(a, b, c, from), end = CGAL::orientation(a, b, c, to);
      if (start == CGAL::ZERO && end == CGAL::ZERO) return std::nullopt;
      if (start == CGAL::ZERO || start == end) continue;  // a line that starts in the plane has left it
      const CGAL::Sign ab = CGAL::orientation(from, to, a, b), bc = CGAL::orientation(from, to, b, c),
                       ca = CGAL::orientation(from, to, c, a);
      const auto has = [&](CGAL::Sign sign) { return ab == sign || bc == sign || ca == sign; };
      if (has(CGAL::POSITIVE) && has(CGAL::NEGATIVE)) continue;
      if (has(CGAL::ZERO)) return std::nullopt;
      add(counts, bodies_[t], start == CGAL::NEGATIVE ? 1 : -1);
    }
    return counts;
  }

  const TriangleMesh& mesh_;
  const std::vector<Point>& points_;
  const std::vector<std::uint32_t>& bodies_;
  std::vector<CGAL::Bbox_3> boxes_;
  CGAL::Bbox_3 all_;
  std::mt19937_64 engine_{1};
};

Vec3d rounded(const Point& p) {
  return {CGAL::to_double(CGAL::exact(p.x())), CGAL::to_double(CGAL::exact(p.y())),
          CGAL::to_double(CGAL::exact(p.z()))};
}

/// Adds the sheet where it separates solid from empty space.
void addWhere(bool isFrontSolid, bool isBackSolid, const Sheet& sheet, PartsOfMesh& parts) {
  if (isFrontSolid == isBackSolid) return;
  Triangle t = sheet.corners;
  if (isFrontSolid) std::swap(t[1], t[2]);
  parts.mesh.triangles.push_back(t);
  parts.source.push_back(sheet.source);
}

/// What a place is to the bodies: bodies may wind around it both ways.
struct Place {
  bool isForward = false, isBackward = false;
};

/// Of a place around which bodies wind so often.
Place placeOf(const Counts& windings, const std::vector<std::uint32_t>& hollowOf) {
  Place place;
  for (const auto& [body, winding] : windings) {
    const auto isHollowOfIt = [&, host = body](const Counts::value_type& other) {
      return other.first != host && hollowOf[other.first] == host;
    };
    if (hollowOf[body] != body || std::ranges::any_of(windings, isHollowOfIt)) continue;
    place.isForward |= winding > 0;
    place.isBackward |= winding < 0;
  }
  return place;
}

UnitedSurface united(const TriangleMesh& mesh, const BodiesOfMesh& bodies) {
  const Arrangement arrangement = arrange(mesh);
  const std::vector<Sheet> sheets = sheetsOf(arrangement, bodies.ofTriangle);
  const std::vector<std::size_t> patches = patchesOf(sheets);
  Winding winding(mesh, arrangement.points, bodies.ofTriangle);
  UnitedSurface result;
  result.cutTriangles = arrangement.cutTriangles;
  result.forward.mesh.name = mesh.name;
  for (const Point& p : arrangement.points) result.forward.mesh.vertices.push_back(rounded(p));
  result.backward.mesh = result.forward.mesh;
  std::vector<Counts> inFront(sheets.size());
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    inFront[s] = patches[s] == s ? winding.inFrontOf(sheets[s]) : inFront[patches[s]];
    const Place front = placeOf(inFront[s], bodies.hollowOf);
    const Place behind = placeOf(sum(inFront[s], sheets[s].layers), bodies.hollowOf);
    addWhere(front.isForward, behind.isForward, sheets[s], result.forward);
    addWhere(front.isBackward, behind.isBackward, sheets[s], result.backward);
  }
  return result;
}

}  // namespace

Result<UnitedSurface> unitedSurface(const TriangleMesh& mesh, const BodiesOfMesh& bodies) try {
  return united(mesh, bodies);
} catch (const std::exception& e) {
  return Error{
      fmt::format("its bodies could not be united ({}); unite them in a modelling program", oneLine(e.what()))};
}

}  // namespace cairn::builder
