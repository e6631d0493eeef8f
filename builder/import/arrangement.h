// SPDX-License-Identifier: GPL-3.0-or-later
//
// Only for the few files that see CGAL.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A mesh cut along all lines in which its triangles meet. Two triangles of it share a vertex, an edge, all three
/// vertices or nothing. Points are exact.
struct Arrangement {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  std::vector<Kernel::Point_3> points;  ///< those of the mesh come first and keep their numbers
  std::vector<Triangle> triangles;      ///< they face as their source does
  std::vector<std::uint32_t> source;    ///< for each triangle: the one of the mesh it is a part of
  std::size_t cutTriangles = 0;         ///< triangles of the mesh that were divided
};

/// Returns the arrangement of a mesh. Precondition: vertices at equal positions are one; no triangle lacks area.
/// O(n log^2 n) plus the cuts, about 50 us each.
Arrangement arrange(const TriangleMesh& mesh);

}  // namespace cairn::builder
