// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// A point of the surface (mesh frame, up to rounding) and its weight in a proof.
struct WeightedPoint {
  Vec3d point;               ///< mesh frame
  std::uint64_t weight = 0;  ///< above 0
};

/// A proved lower bound: if `spheres` balls cover the mesh's surface, one of them protrudes by more than `error`. A
/// ball protrudes by the distance from the solid to its farthest point.
///
/// The proof is `weights`. No ball that protrudes by `error` or less holds points with a total weight above
/// `mostInOneBall`. The product of `spheres` and `mostInOneBall` is less than the total weight of all points.
///
///     ErrorBound bound = lowerErrorBound(mesh, 64).value();
///     double efficiency = bound.error / certificate.levels[2].maxProtrusion; // 1: no cover can be better
struct ErrorBound {
  std::uint32_t spheres = 0;           ///< number of balls in the statement
  double error = 0;                    ///< mesh unit; 0: nothing was proved, and `weights` is empty
  std::vector<WeightedPoint> weights;  ///< the sum of the weights stays below 2^64
  std::uint64_t mostInOneBall = 0;     ///< upper bound of the weight in one ball
  bool stoppedByTime = false;          ///< the search was not over; more time may prove more
};

/// The effort of `lowerErrorBound`.
struct BoundOptions {
  std::uint32_t points = 0;  ///< surface points to be covered: 8..20000; 0: chosen by the number of spheres
  /// Wall time after which the best bound so far is returned, above 0; nothing: until the search ends by itself.
  std::optional<double> seconds;
};

/// Proves a lower bound of the error (worst protrusion) of every cover of the surface by `spheres` balls. The bound
/// holds for any method that makes a cover; the proof uses the duality of fractional covers. The bound is weak for many
/// spheres, because a fractional cover is cheaper than a cover. Errors tried are fractions 2^(-k/64) of the bounding
/// box's diagonal. A few points give a first bound in a moment; more points make it tighter, stage by stage.
///
/// Precondition: `checkMesh(mesh)`. Fails for options out of range and with `kCancelled`. With `seconds` it returns
/// within a fraction of a second after them, and the result depends on the machine. Without, it may take minutes, and
/// the result does not depend on the number of threads. Parallel. See docs/algorithms/lower-bound.md.
Result<ErrorBound> lowerErrorBound(const TriangleMesh& mesh, std::uint32_t spheres, const BoundOptions& options = {},
                                   const ProgressCallback& progress = {});

}  // namespace cairn::builder
