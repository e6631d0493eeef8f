// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A triangle that lies in one triangle of the mesh (mesh frame). The regions of a sphere-tree are sets of pieces, not
/// of sample points: a ball is convex, so it holds a piece iff it holds the three corners, and cover needs no sampling.
struct Piece {
  std::array<Vec3d, 3> corners;
  std::uint32_t source = 0;  ///< triangle of the mesh

  friend bool operator==(const Piece&, const Piece&) = default;
};

using Pieces = std::vector<Piece>;

double longestEdgeSq(const Piece& piece);
double areaOf(const Piece& piece);
Vec3d centroidOf(const Piece& piece);

/// The first corner of the longest edge, the first such edge on a tie; the edge runs to the next corner.
std::size_t longestEdge(const Piece& piece);
/// The two halves of a piece cut at the middle of the edge that begins at corner `first`: without the edge's end, and
/// without its beginning. Both neighbours of an edge compute the same midpoint, bit for bit.
std::array<Piece, 2> cutAt(const Piece& piece, std::size_t first);
/// The two halves of a piece cut at its longest edge.
std::array<Piece, 2> bisect(const Piece& piece);

/// One piece for each triangle of the mesh.
Pieces piecesOf(const TriangleMesh& mesh);

/// Bisects the piece with the longest edge until there are `count`; leaves larger sets alone. The result covers exactly
/// what `pieces` covered. O(n log n).
void refinePieces(Pieces& pieces, std::size_t count);

/// The corners of the pieces, each position once, in lexicographic order.
std::vector<Vec3d> cornersOf(std::span<const Piece> pieces);

}  // namespace cairn::builder
