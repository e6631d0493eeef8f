// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Counts of the changes that `repair` made, for reports.
struct RepairCounts {
  std::size_t duplicateTriangles = 0;  ///< dropped: they have the three vertices of an earlier triangle
  std::size_t joinedVertices = 0;      ///< border vertices moved onto another one closer than the tolerance
  std::size_t splitTriangles = 0;      ///< triangles split at a border vertex on their edge
  std::size_t collapsedTriangles = 0;  ///< triangles that joining left without area; dropped
  std::size_t filledHoles = 0;         ///< borders closed with new triangles
  std::size_t addedTriangles = 0;      ///< triangles that fill the holes
  std::size_t turnedTriangles = 0;     ///< triangles turned to face away from the solid

  /// True when anything was changed.
  bool any() const;
  /// For example "3 holes filled with 8 triangles, 12 triangles turned"; "nothing" when nothing was changed.
  std::string text() const;
};

/// Turns a surface that almost bounds a solid into one that does. Duplicate triangles are dropped, borders stitched,
/// orientation made consistent and holes filled. Every shell is turned to face away from the solid; a shell inside
/// another becomes a cavity. The filling of a hole is a guess. A certificate is about the repaired mesh, not about the
/// file.
///
/// The result has passed `checkMesh`, and its coordinates are floats. It equals the mesh that `importMesh` reads from
/// `plyBytes`, and carries the SHA-256 of these bytes. Fails, with the place, for edges of more than two triangles,
/// surfaces without a consistent side and triangles that cross. Also fails for holes of more than `kMaxHoleEdges` edges
/// and for holes that cannot be filled. `wrap` accepts all of these.
///
/// `counts` may be null. Precondition: a mesh of `importSurface`. Single thread. O(n log n) plus the square of a
/// border's length. Source: see docs/algorithms/repair.md.
///
///     RepairCounts counts;
///     Result<TriangleMesh> mesh = repair(importSurface("scan.ply").value(), &counts);
Result<TriangleMesh> repair(const TriangleMesh& surface, RepairCounts* counts = nullptr);

/// Border vertices closer than this fraction of the bounding box's diagonal are joined. It is a few units of float
/// rounding.
inline constexpr double kStitchTolerance = 1e-6;
/// A border of more edges counts as the rim of an open sheet, not as a hole.
inline constexpr std::size_t kMaxHoleEdges = 5000;

}  // namespace cairn::builder
