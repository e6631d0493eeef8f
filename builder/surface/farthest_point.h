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
  Vec3d witness;     ///< of `from`, up to rounding
};

/// It stops when upper <= lower * (1 + relative) + absolute, or after `maxQueries` distance queries beyond one for each
/// triangle and vertex (then the bounds are as valid, only farther apart).
struct FarthestTolerance {
  double relative = 0.01;
  double absolute = 0;  ///< mesh unit
  std::uint64_t maxQueries = 2'000'000;
};

/// Best-first branch and bound over pieces of `from`'s triangles. On a piece, the distance to `to` is at most that to
/// any one triangle of `to`, which is convex and so largest at a corner of the piece; the triangle nearest to the
/// middle is taken. Precondition: `from` has a triangle. Deterministic, single thread. O(1) queries a triangle where
/// the surfaces are alike.
FarthestPoint farthestPoint(const TriangleMesh& from, const SurfaceDistance& to, const FarthestTolerance& tolerance);

}  // namespace cairn::builder
