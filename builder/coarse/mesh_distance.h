// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "surface/surface_distance.h"

namespace cairn::builder {

/// Bounds of the greatest distance between two surfaces, both ways: the Hausdorff distance. Mesh frame and unit.
struct MeshDistance {
  double upper = 0;  ///< no point of either surface is farther from the other
  double lower = 0;  ///< some point of one surface is at least this far from the other
};

/// Encloses the Hausdorff distance to one per cent, or to `absolute` (mesh unit), rounding included. See
/// `farthestPoint`. `distanceToSource` is that of `source`. Deterministic, single thread.
MeshDistance meshDistance(const TriangleMesh& mesh, const TriangleMesh& source, const SurfaceDistance& distanceToSource,
                          double absolute);

}  // namespace cairn::builder
