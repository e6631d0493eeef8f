// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// One side of an edge: the triangle it belongs to and the two vertices in that triangle's order.
struct HalfEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t triangle = 0;
  std::uint32_t side = 0;  ///< it runs from corner `side` of the triangle

  std::uint32_t low() const { return from < to ? from : to; }
  std::uint32_t high() const { return from < to ? to : from; }
  bool sameEdge(const HalfEdge& o) const { return low() == o.low() && high() == o.high(); }
};

/// All half-edges, those of one edge next to each other, within an edge by triangle. O(n log n).
std::vector<HalfEdge> sortedHalfEdges(const TriangleMesh& mesh);

/// A number per triangle: which shell it belongs to, two triangles with a common edge to the same. Shells are numbered
/// by their first triangle. Precondition: `halfEdges` are `sortedHalfEdges(mesh)`.
struct Shells {
  std::vector<std::uint32_t> ofTriangle;
  std::uint32_t count = 0;
};
Shells shellsOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges);

}  // namespace cairn::builder
