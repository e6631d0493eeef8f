// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// The same triangles with consistent sides, the holes between them filled, every shell turned to face away from the
/// solid; where no consistent sides exist the result has edges `checkMesh` refuses. CGAL's Polygon_mesh_processing.
/// Fails, without the mesh's name, when a hole cannot be filled and when triangles intersect. Precondition: stitched,
/// no two triangles with the same vertices, no vertex unused.
Result<TriangleMesh> closeSurface(const TriangleMesh& mesh, RepairCounts& counts);

}  // namespace cairn::builder
