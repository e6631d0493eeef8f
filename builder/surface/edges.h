// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// One side of an edge: its triangle, and the two vertices in that triangle's order.
struct HalfEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t triangle = 0;
  std::uint32_t side = 0;  ///< it starts at corner `side` of the triangle

  std::uint32_t low() const { return from < to ? from : to; }
  std::uint32_t high() const { return from < to ? to : from; }
  bool sameEdge(const HalfEdge& o) const { return low() == o.low() && high() == o.high(); }
};

/// Returns all half-edges. Those of one edge are adjacent, sorted by triangle. O(n log n).
std::vector<HalfEdge> sortedHalfEdges(const TriangleMesh& mesh);

/// The number of its shell for each triangle; triangles with a common edge belong to the same shell. Shells are
/// numbered by their first triangle. Precondition of `shellsOf`: `halfEdges` are `sortedHalfEdges(mesh)`.
struct Shells {
  std::vector<std::uint32_t> ofTriangle;
  std::uint32_t count = 0;
};
Shells shellsOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges);

}  // namespace cairn::builder
