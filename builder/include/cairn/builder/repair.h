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
  std::size_t movedTriangles = 0;      ///< triangles moved outward where surfaces nearly coincided
  std::size_t closedGaps = 0;          ///< pairs of bodies closer than the tolerance whose gap was filled
  std::size_t unitedBodies = 0;        ///< bodies that became one with another one
  std::size_t enclosedBodies = 0;      ///< bodies inside others and hollows inside hollows; left out
  std::size_t cutTriangles = 0;        ///< triangles cut where surfaces met
  std::size_t foldedTriangles = 0;     ///< parts of triangles where the surface folded through itself
  std::size_t beadedEdges = 0;         ///< edges where solids only touched; thickened

  /// True when anything was changed.
  bool any() const;
  /// For example "3 holes filled with 8 triangles, 12 triangles turned"; "nothing" when nothing was changed.
  std::string text() const;
};

/// Border vertices closer than this fraction of the bounding box's diagonal are joined first. It is a few units of
/// float rounding.
inline constexpr double kStitchTolerance = 1e-6;
/// A border of more edges counts as the rim of an open sheet, not as a hole.
inline constexpr std::size_t kMaxHoleEdges = 5000;
inline constexpr double kMaxWeld = 0.01;  ///< greatest `RepairOptions::weld`

/// Options of `repair`.
struct RepairOptions {
  /// Gaps of at most this fraction of the bounding box's diagonal are closed: between borders that
  /// `kStitchTolerance` left open, and between bodies; 0..kMaxWeld, 0 for none.
  double weld = 2e-5;
};

/// Turns a surface that almost bounds a solid into one that does. Duplicate triangles are dropped, borders stitched,
/// orientation made consistent and holes filled. Bodies that overlap, touch or are closer than the weld become one. A
/// body inside another one is left out if both face the same way. It stays a hollow if not, and if it touches nothing
/// of it. Where a surface folds
/// through itself, the inverted part becomes solid, and grows by one and a half welds, at needles by twelve. The
/// filling of a hole is a guess. A certificate is about the repaired mesh, not about the file.
///
/// The result has passed `checkMesh`, and its coordinates are floats. It equals the mesh that `importMesh` reads from
/// `plyBytes`, and carries the SHA-256 of these bytes. No point of a body is farther outside of it than twice the weld.
/// Fails, with the place, for edges of three triangles, surfaces without a consistent side and surfaces that wind
/// backwards. Also fails for holes of more than `kMaxHoleEdges` edges and for holes that cannot be filled. `wrap`
/// accepts all of these.
///
/// `counts` may be null. Precondition: a mesh of `importSurface`. Single thread. O(n log n) plus the square of a
/// border's length, and about ten milliseconds for each triangle that crosses others. Source:
/// docs/algorithms/import.md.
///
///     RepairCounts counts;
///     Result<TriangleMesh> mesh = repair(importSurface("scan.ply").value(), &counts);
Result<TriangleMesh> repair(const TriangleMesh& surface, RepairCounts* counts = nullptr,
                            const RepairOptions& options = {});

}  // namespace cairn::builder
