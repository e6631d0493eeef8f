// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Counts of elements that `importMesh` dropped without a change of the surface, for reports.
struct ImportCounts {
  std::size_t degenerateTriangles = 0;  ///< triangles without area
};

/// True when the file's name has the extension of a format that `importMesh` reads. The file itself is not opened.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a mesh file of any format that assimp supports. All meshes of the file are placed by their nodes and joined.
/// Polygons are triangulated. Vertices at exactly equal positions are welded, so that STL soups close. Vertices without
/// a triangle are dropped.
///
/// OBJ, OFF, PLY and text STL give the doubles nearest to the file's coordinates. Coordinates of other formats pass
/// through float, as assimp stores them. This is also true for rare variants (`4OFF`, `nOFF`, PLY of strips). All
/// coordinates must be finite as floats, because a tree stores floats.
///
/// The result has passed `checkMesh`. Defects that assimp would not report are checked first: a truncated binary STL, a
/// PLY that lacks elements. A UTF-8 byte order mark before a text is skipped. Fails with one sentence that names the
/// file and the place. `counts` may be null. O(n log n).
///
///     Result<TriangleMesh> mesh = importMesh("bunny.obj");
///     if (!mesh.ok()) return fail(mesh.error());
Result<TriangleMesh> importMesh(const std::filesystem::path& path, ImportCounts* counts = nullptr);

/// Reads a mesh file as `importMesh` does, but without `checkMesh`. The result is welded and free of triangles without
/// area. It may be open, inconsistently oriented or self-intersecting. `repair` and `wrap` take it as input. Fails for
/// a file that cannot be read at all.
Result<TriangleMesh> importSurface(const std::filesystem::path& path, ImportCounts* counts = nullptr);

/// Checks that a mesh bounds a solid; every other function relies on this. Coordinates are finite and indices are in
/// range. No triangle is without area. Every edge lies between exactly two triangles that agree on its direction. No
/// two triangles intersect. Every shell faces away from the solid (cavities face inward), and the volume is not zero.
///
/// Several shells are allowed. Vertices where two cones of surface touch in one point are allowed too: distance, sign
/// and integrals are well defined there. The error names the first offending element (triangles count from 0) and the
/// remedy. `leftOut` is the number of triangles without area that an import dropped, which may be why a mesh is open.
/// O(n log n), exact predicates.
Status checkMesh(const TriangleMesh& mesh, std::size_t leftOut = 0);

}  // namespace cairn::builder
