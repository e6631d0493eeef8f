// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A triangle that lies in one triangle of the mesh (mesh frame). Regions of a sphere-tree are sets of pieces, not of
/// sample points. A ball is convex, so it holds a piece exactly when it holds the three corners. Cover therefore needs
/// no sampling.
struct Piece {
  std::array<Vec3d, 3> corners;
  std::uint32_t source = 0;  ///< triangle of the mesh

  friend bool operator==(const Piece&, const Piece&) = default;
};

using Pieces = std::vector<Piece>;

double longestEdgeSq(const Piece& piece);
double areaOf(const Piece& piece);
Vec3d centroidOf(const Piece& piece);

/// Returns the corner at which the longest edge begins; the first such edge on a tie. The edge runs to the next corner.
std::size_t longestEdge(const Piece& piece);
/// Cuts a piece at the middle of the edge that begins at corner `first`. The first half lacks the edge's end, the
/// second half its beginning. Both neighbours of an edge compute the same midpoint, bit for bit.
std::array<Piece, 2> cutAt(const Piece& piece, std::size_t first);
/// Cuts a piece at the middle of its longest edge.
std::array<Piece, 2> bisect(const Piece& piece);

/// Returns one piece for each triangle of the mesh.
Pieces piecesOf(const TriangleMesh& mesh);

/// Bisects the piece with the longest edge until there are `count` pieces. Larger sets stay unchanged. The result
/// covers exactly the area of the given pieces. O(n log n).
void refinePieces(Pieces& pieces, std::size_t count);

/// Returns the corners of the pieces in lexicographic order, each position once.
std::vector<Vec3d> cornersOf(std::span<const Piece> pieces);

}  // namespace cairn::builder
