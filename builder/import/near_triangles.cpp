// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/near_triangles.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <set>

namespace cairn::builder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Kernel::Triangle_3 triangleOf(const TriangleMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.corners(t);
  return {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
}

std::vector<Box> boxesOf(const TriangleMesh& mesh, double margin) {
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const CGAL::Bbox_3 b = triangleOf(mesh, t).bbox();
    boxes.emplace_back(CGAL::Bbox_3(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                                    b.ymax() + margin, b.zmax() + margin),
                       t);
  }
  return boxes;
}

Vec3d normalOf(const TriangleMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.corners(t);
  return normalized(cross(b - a, c - a));
}

double longestEdge(const TriangleMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.corners(t);
  return std::max({length(b - a), length(c - b), length(a - c)});
}

bool areCoplanar(const Kernel::Triangle_3& a, const Kernel::Triangle_3& b) {
  for (int i = 0; i < 3; ++i)
    if (!CGAL::coplanar(a[0], a[1], a[2], b[i])) return false;
  return true;
}

}  // namespace

std::vector<std::uint32_t> trianglesFlush(const TriangleMesh& body, const TriangleMesh& other, double distance) {
  std::vector<Box> boxesA = boxesOf(body, distance), boxesB = boxesOf(other, 0);
  std::set<std::uint32_t> flush;
  CGAL::box_intersection_d(boxesA.begin(), boxesA.end(), boxesB.begin(), boxesB.end(), [&](const Box& a, const Box& b) {
    if (flush.contains(a.info())) return;
    const double parting = length(cross(normalOf(body, a.info()), normalOf(other, b.info())));
    if (parting * std::min(longestEdge(body, a.info()), longestEdge(other, b.info())) > distance) return;
    const Kernel::Triangle_3 mine = triangleOf(body, a.info()), its = triangleOf(other, b.info());
    if (areCoplanar(mine, its) || CGAL::squared_distance(mine, its) > distance * distance) return;
    flush.insert(a.info());
  });
  return {flush.begin(), flush.end()};
}

std::vector<std::uint32_t> trianglesNear(const TriangleMesh& body, const TriangleMesh& other, double distance) {
  constexpr double kFacing = -0.05;  // cosine: sides of a tight fit, which stand square to the gap, do not count
  std::vector<Box> boxesA = boxesOf(body, distance), boxesB = boxesOf(other, 0);
  std::set<std::uint32_t> near, facing;
  CGAL::box_intersection_d(boxesA.begin(), boxesA.end(), boxesB.begin(), boxesB.end(), [&](const Box& a, const Box& b) {
    const bool faces = dot(normalOf(body, a.info()), normalOf(other, b.info())) < kFacing;
    if (facing.contains(a.info()) || (!faces && near.contains(a.info()))) return;
    if (CGAL::squared_distance(triangleOf(body, a.info()), triangleOf(other, b.info())) > distance * distance) return;
    near.insert(a.info());
    if (faces) facing.insert(a.info());
  });
  const std::set<std::uint32_t>& found = facing.empty() ? near : facing;
  return {found.begin(), found.end()};
}

}  // namespace cairn::builder
