// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"
#include "surface/surface_distance.h"

namespace cairn::builder {

/// The largest distance from a point of one surface to another surface (the one-sided Hausdorff distance), enclosed
/// from both sides, rounding included. Mesh frame and unit.
struct FarthestPoint {
  double upper = 0;  ///< no point is farther
  double lower = 0;  ///< `witness` is at least this far
  Vec3d witness;     ///< a point of `from`, up to rounding
};

/// The end conditions: upper <= lower * (1 + relative) + absolute, or `maxQueries` distance queries beyond one for each
/// triangle and vertex. In the second case the bounds are valid too, but less tight.
struct FarthestTolerance {
  double relative = 0.01;
  double absolute = 0;  ///< mesh unit
  std::uint64_t maxQueries = 2'000'000;
};

/// Finds the farthest point by best-first branch and bound over pieces of `from`'s triangles. On a piece, the distance
/// to `to` is at most the distance to any one triangle of `to`. That distance is convex, so it is largest at a corner
/// of the piece. The triangle nearest to the piece's middle is used. Precondition: `from` has a triangle.
/// Deterministic, single thread. O(1) queries for each triangle where the surfaces are similar.
FarthestPoint farthestPoint(const TriangleMesh& from, const SurfaceDistance& to, const FarthestTolerance& tolerance);

}  // namespace cairn::builder
