// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse/mesh_distance.h"

#include <algorithm>

#include "surface/farthest_point.h"

namespace cairn::builder {

MeshDistance meshDistance(const TriangleMesh& mesh, const TriangleMesh& source, const SurfaceDistance& distanceToSource,
                          double absolute) {
  const FarthestTolerance tolerance{.absolute = absolute};
  const FarthestPoint ofMesh = farthestPoint(mesh, distanceToSource, tolerance);
  const FarthestPoint ofSource = farthestPoint(source, SurfaceDistance(mesh), tolerance);
  return {std::max(ofMesh.upper, ofSource.upper), std::max(ofMesh.lower, ofSource.lower)};
}

}  // namespace cairn::builder
