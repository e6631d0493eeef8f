// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/close_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <utility>
#include <vector>

#include "import/bodies.h"
#include "import/border.h"
#include "import/flat_patch.h"
#include "import/one_line.h"
#include "import/settle.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<Vec3d, 3>;

Point pointOf(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

/// Corners in CGAL's form with consistent sides. Vertices are doubled where sheets of different sides, more than two
/// triangles or two cones of surface meet. So each sheet has its own vertices.
struct OrientedSoup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;

  explicit OrientedSoup(const TriangleMesh& mesh) {
    for (const Vec3d& v : mesh.vertices) points.push_back(pointOf(v));
    for (const Triangle& t : mesh.triangles) faces.emplace_back(t.begin(), t.end());
    pmp::orient_polygon_soup(points, faces);
  }
};

/// Makes sides consistent where that is possible, and joins the doubled vertices again.
TriangleMesh oriented(const TriangleMesh& mesh) {
  const OrientedSoup soup(mesh);
  TriangleMesh result;
  for (const Point& p : soup.points) result.vertices.push_back({p.x(), p.y(), p.z()});
  for (const auto& f : soup.faces)
    result.triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  return settled(result);
}

/// Triangles over a rim, as indices along it, in either direction. Long rims get no search of all triangulations,
/// because its cost is the cube of their edges.
Patch patchOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& rim) {
  if (rim.size() == 3) return {{0, 1, 2}};
  std::vector<Vec3d> corners;
  for (const HalfEdge& e : rim) corners.push_back(mesh.vertices[e.from]);
  if (Patch flat = flatPatch(corners, kStitchTolerance * boundsOf(mesh).diagonal()); !flat.empty()) return flat;

  constexpr std::size_t kMaxCubicEdges = 300;
  std::vector<Point> points,
      beside;  // `beside`: corners of the triangles along the rim, which the patch should continue
  for (const HalfEdge& e : rim) {
    points.push_back(pointOf(mesh.vertices[e.from]));
    beside.push_back(pointOf(mesh.vertices[mesh.triangles[e.triangle][(e.side + 2) % 3]]));
  }
  std::vector<CGAL::Triple<int, int, int>> found;
  pmp::triangulate_hole_polyline(
      points, beside, std::back_inserter(found),
      CGAL::parameters::use_2d_constrained_delaunay_triangulation(false).do_not_use_cubic_algorithm(rim.size() >
                                                                                                    kMaxCubicEdges));
  Patch patch;
  for (const auto& t : found) patch.push_back({t.first, t.second, t.third});
  return patch;
}

Status fillHoles(TriangleMesh& mesh, RepairCounts& counts) {
  for (const std::vector<HalfEdge>& rim : borderLoops(mesh)) {
    const Vec3d where = mesh.vertices[rim.front().from];
    const auto refused = [&](const char* why) {
      return Error{fmt::format("the hole of {} edges at ({:.6g}, {:.6g}, {:.6g}) {}", rim.size(), where.x, where.y,
                               where.z, why)};
    };
    if (rim.size() > kMaxHoleEdges) return refused("looks like the rim of an open sheet; close or thicken it");
    const auto patch = patchOf(mesh, rim);
    if (patch.empty()) return refused("cannot be filled with triangles between its edges; close it");
    const auto from = [&](int place) { return rim[static_cast<std::size_t>(place)].from; };
    for (const auto& [a, b, c] : patch) mesh.triangles.push_back({from(a), from(b), from(c)});
    ++counts.filledHoles;
    counts.addedTriangles += patch.size();
  }
  return {};
}

bool sameSide(const Corners& a, const Corners& b) {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    if (a[0] == b[turn] && a[1] == b[(turn + 1) % 3] && a[2] == b[(turn + 2) % 3]) return true;
  }
  return false;
}

/// Which side was out is a matter of the source's triangles: of each body, the side that most of them faced.
void faceAsMost(TriangleMesh& mesh, const TriangleMesh& source) {
  const Shells bodies = bodiesOf(mesh);
  std::vector<std::ptrdiff_t> kept(bodies.count);
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t)
    kept[bodies.ofTriangle[t]] += sameSide(source.corners(t), mesh.corners(t)) ? 1 : -1;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (kept[bodies.ofTriangle[t]] < 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

/// A sheet's only filling may be the sheet itself, seen from behind.
Status checkFilling(const TriangleMesh& mesh, std::size_t sourceTriangles) {
  for (const Body& body : separated(mesh, bodiesOf(mesh))) {
    const Vec3d size = body.bounds.upper - body.bounds.lower, where = body.mesh.vertices[0];
    // As `checkMesh` has it.
    const double rounding = 0x1p-50 * static_cast<double>(body.triangles.size()) * size.x * size.y * size.z;
    if (body.triangles.back() < sourceTriangles || std::abs(signedVolume(body.mesh)) > rounding) continue;
    return Error{
        fmt::format("the sheet at ({:.6g}, {:.6g}, {:.6g}) encloses nothing when its border is filled; give it "
                    "thickness or remove it",
                    where.x, where.y, where.z)};
  }
  return {};
}

Result<TriangleMesh> closed(const TriangleMesh& source, RepairCounts& counts) {
  TriangleMesh mesh = isBalanced(source) ? source : oriented(source);
  if (Status s = fillHoles(mesh, counts); !s) return s.error();
  if (!isBalanced(mesh)) mesh = oriented(mesh);  // patches face either way
  if (!isBalanced(mesh)) return mesh;            // `checkMesh` will name the edge
  if (Status s = checkFilling(mesh, source.triangles.size()); !s) return s.error();
  faceAsMost(mesh, source);
  faceOutward(mesh, bodiesOf(mesh));
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t)
    counts.turnedTriangles += !sameSide(source.corners(t), mesh.corners(t));
  return mesh;
}

}  // namespace

Result<TriangleMesh> closeSurface(const TriangleMesh& mesh, RepairCounts& counts) try {
  return closed(mesh, counts);
} catch (const std::exception& e) {
  return Error{fmt::format("it could not be closed ({}); repair it in a modelling program", oneLine(e.what()))};
}

}  // namespace cairn::builder
