// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// What `repair` did, for reports.
struct RepairCounts {
  std::size_t duplicateTriangles = 0;  ///< left out: the same three vertices as an earlier triangle
  std::size_t joinedVertices = 0;      ///< of borders, moved onto another border vertex closer than the tolerance
  std::size_t splitTriangles = 0;      ///< at a border vertex that lay on their edge
  std::size_t collapsedTriangles = 0;  ///< left without area by joining, and left out
  std::size_t filledHoles = 0;         ///< borders closed with new triangles
  std::size_t addedTriangles = 0;      ///< in the holes
  std::size_t turnedTriangles = 0;     ///< to face away from the solid

  /// Whether anything was changed at all.
  bool any() const;
  /// "3 holes filled with 8 triangles, 12 triangles turned"; "nothing" when there was nothing to do.
  std::string text() const;
};

/// A surface that almost bounds a solid made to bound one: duplicate triangles left out, borders stitched, orientation
/// made consistent, holes filled, every shell turned to face away from the solid (one inside another becomes a cavity).
/// What it adds inside a hole is a guess; a certificate is about the repaired mesh, not the file.
///
/// The result has passed `checkMesh`; its coordinates are floats, and it is the mesh `importMesh` reads from
/// `plyBytes`, whose SHA-256 it carries. Fails, with the place, where that is not enough: edges of more than two
/// triangles, surfaces without a consistent side, triangles that cross, holes of more than `kMaxHoleEdges` edges or
/// that no triangles fill. `wrap` takes those. `counts` may be null. Precondition: a mesh of `importSurface`.
/// O(n log n) and the square of a border's length. Single thread. Source: see docs/algorithms/import.md.
Result<TriangleMesh> repair(const TriangleMesh& surface, RepairCounts* counts = nullptr);

/// Border vertices closer than this fraction of the bounding box's diagonal are one: a few units of float rounding.
inline constexpr double kStitchTolerance = 1e-6;
/// A border of more edges is the rim of an open sheet rather than a hole.
inline constexpr std::size_t kMaxHoleEdges = 5000;

}  // namespace cairn::builder
