// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// What `importMesh` left out without changing the surface, for reports.
struct ImportCounts {
  std::size_t degenerateTriangles = 0;  ///< triangles without area
};

/// Whether a file's name has the extension of a format that `importMesh` reads. The file is not looked at.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a mesh file of any format assimp knows: all its meshes, placed by their nodes, polygons triangulated, vertices
/// at exactly equal positions welded (so STL soups close), vertices no triangle uses left out. Coordinates of OBJ, OFF,
/// PLY and text STL are the doubles nearest to what the file says; those of other formats, and of the rarer forms of
/// these (`4OFF`, `nOFF`, PLY of strips), pass through float, as assimp keeps them. All must be finite as floats, which
/// is what a tree keeps.
///
/// The result has passed `checkMesh`. What assimp would not report (a truncated binary STL, a PLY that lacks elements)
/// is checked first. A UTF-8 byte order mark before a text is passed over. Fails with one sentence that names the file
/// and the place. `counts` may be null. O(n log n).
Result<TriangleMesh> importMesh(const std::filesystem::path& path, ImportCounts* counts = nullptr);

/// The same without `checkMesh`: welded and free of triangles without area, but maybe open, turned in places or
/// crossing itself. What `repair` and `wrap` start from. Fails for what cannot be read at all.
Result<TriangleMesh> importSurface(const std::filesystem::path& path, ImportCounts* counts = nullptr);

/// Whether a mesh bounds a solid, which everything else relies on: finite, indices in range, no triangle without area,
/// every edge between exactly two triangles that agree on its direction, no two triangles that intersect, every shell
/// facing away from the solid (cavities inward), a volume that is not zero. Several shells are fine, and so are
/// vertices where two cones of surface touch in one point: distance, sign and integrals are well defined there. The
/// error names the first offending element (triangles count from 0) and what to do; `leftOut` is how many triangles
/// without area an import dropped, which may be why a mesh is open. O(n log n), exact predicates.
Status checkMesh(const TriangleMesh& mesh, std::size_t leftOut = 0);

}  // namespace cairn::builder
