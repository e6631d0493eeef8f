// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Makes the triangles' sides consistent, fills the holes between them, and turns bodies as `faceOutward` does. Bodies
/// may still cross. Where no consistent sides exist, the result has edges that `checkMesh` refuses. Uses CGAL's
/// Polygon_mesh_processing. Fails, without the mesh's name, when a hole cannot be filled.
/// Precondition: the mesh is stitched, without repeated triangles and without unused vertices.
Result<TriangleMesh> closeSurface(const TriangleMesh& mesh, RepairCounts& counts);

}  // namespace cairn::builder
