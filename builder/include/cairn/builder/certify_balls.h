// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// A largest distance, enclosed from both sides, rounding included. Mesh frame and unit.
struct EnclosedDistance {
  double upper = 0;  ///< proved: no point is farther
  double lower = 0;  ///< `witness` is at least this far
  Vec3d witness;     ///< meaningful where `lower` is above 0
};

/// The proof about one ball of a set. Mesh frame and unit.
struct BallProof {
  EnclosedDistance protrusion;  ///< from a point of the ball to the solid
  double innerRadius = 0;  ///< the concentric ball of this radius, at most its own, lies in the solid; 0: none does
};

/// The proof about a set of balls and the solid M that a mesh bounds. U is the union of the balls.
struct BallsCertificate {
  std::vector<BallProof> balls;    ///< one proof for each ball, in their order
  EnclosedDistance sticksOut;      ///< largest distance from a point of U to M
  EnclosedDistance leavesSurface;  ///< largest distance from a point of the surface of M to U; 0: U covers the surface
  EnclosedDistance leavesSolid;    ///< largest distance from a point of M to U; 0: U covers the solid
};

/// Proves how far a set of balls sticks out of a solid, and how much of the solid it leaves out, by branch and bound;
/// nothing is sampled. Centres and radii are taken as the exact reals their doubles are.
///
/// On a piece of a triangle or a cube the distance to one ball, |x - c| - r, is convex, so it is largest at a corner;
/// the least of these over the balls bounds the piece. Pieces are divided until upper and lower bound agree to 1 % or
/// 1e-4 of the bounding box's diagonal; `sticksOut` to 0.2 % or 1e-5. A surface whose pieces all lie in balls has an
/// upper bound of exactly 0.
///
/// Preconditions: `checkMesh(mesh)`; `balls` not empty, all finite, radii above 0. Fails only with `kCancelled`.
/// Parallel; the result does not depend on the number of threads. Some milliseconds for 256 balls and 1500 triangles.
Result<BallsCertificate> certifyBalls(std::span<const Ball> balls, const TriangleMesh& mesh,
                                      const ProgressCallback& progress = {});

}  // namespace cairn::builder
