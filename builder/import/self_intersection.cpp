// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's polygon-mesh function needs a manifold halfedge structure, which excludes vertices where two cones touch. The
// predicates below work on indices. CGAL supplies the box sweep and the exact tests.
#include "import/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <vector>

namespace cairn::builder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Point pointOf(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

/// Two triangles whose shared vertices come first, in the same order in both.
struct AlignedPair {
  std::array<Point, 3> a, b;
  int shared = 0;
};

AlignedPair align(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second) {
  Triangle a = mesh.triangles[first], b = mesh.triangles[second];
  AlignedPair pair;
  for (int i = pair.shared; i < 3; ++i) {
    const auto same = std::find(b.begin() + pair.shared, b.end(), a[i]);
    if (same == b.end()) continue;
    std::swap(a[i], a[pair.shared]);
    std::swap(*same, b[pair.shared]);
    ++pair.shared;
  }
  for (int i = 0; i < 3; ++i) {
    pair.a[i] = pointOf(mesh.vertices[a[i]]);
    pair.b[i] = pointOf(mesh.vertices[b[i]]);
  }
  return pair;
}

bool intersects(const AlignedPair& pair) {
  const auto& [a, b, shared] = pair;
  const Kernel::Triangle_3 triangleA(a[0], a[1], a[2]), triangleB(b[0], b[1], b[2]);
  switch (shared) {
    case 0:
      return CGAL::do_intersect(triangleA, triangleB);
    case 1:
      // For an intersection beyond the common corner, an edge opposite to it must meet the other triangle.
      return CGAL::do_intersect(triangleA, Kernel::Segment_3(b[1], b[2])) ||
             CGAL::do_intersect(triangleB, Kernel::Segment_3(a[1], a[2]));
    case 2:
      // For an intersection beyond the common edge, one triangle must be folded flat onto the other.
      return CGAL::coplanar(a[0], a[1], a[2], b[2]) &&
             CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::POSITIVE;
    default:
      return true;  // the same three vertices
  }
}

std::vector<Box> boxesOf(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    CGAL::Bbox_3 box;
    for (const Vec3d& c : corners) box += pointOf(c).bbox();
    boxes.emplace_back(box, t);
  }
  return boxes;
}

}  // namespace

std::optional<std::pair<std::uint32_t, std::uint32_t>> findSelfIntersection(const TriangleMesh& mesh) {
  std::vector<Box> boxes = boxesOf(mesh);
  std::optional<std::pair<std::uint32_t, std::uint32_t>> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a.info(), b.info());
    if (found && *found <= pair) return;
    if (intersects(align(mesh, pair.first, pair.second))) found = pair;
  });
  return found;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> findSelfIntersections(const TriangleMesh& mesh) {
  std::vector<Box> boxes = boxesOf(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a.info(), b.info());
    if (intersects(align(mesh, pair.first, pair.second))) found.push_back(pair);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> findCrossing(const TriangleMesh& first,
                                                                    const TriangleMesh& second) {
  const auto triangleOf = [](const TriangleMesh& mesh, std::uint32_t t) {
    const auto c = mesh.corners(t);
    return Kernel::Triangle_3(pointOf(c[0]), pointOf(c[1]), pointOf(c[2]));
  };
  std::vector<Box> boxesA = boxesOf(first), boxesB = boxesOf(second);
  std::optional<std::pair<std::uint32_t, std::uint32_t>> found;
  CGAL::box_intersection_d(boxesA.begin(), boxesA.end(), boxesB.begin(), boxesB.end(), [&](const Box& a, const Box& b) {
    const std::pair pair(a.info(), b.info());
    if (found && *found <= pair) return;
    if (CGAL::do_intersect(triangleOf(first, pair.first), triangleOf(second, pair.second))) found = pair;
  });
  return found;
}

}  // namespace cairn::builder
