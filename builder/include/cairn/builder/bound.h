// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// A point of the surface (mesh frame, up to rounding) and its share in a proof.
struct WeightedPoint {
  Vec3d point;               ///< mesh frame
  std::uint64_t weight = 0;  ///< above 0
};

/// No `spheres` balls cover the mesh's surface unless one of them protrudes by more than `error`: has a point farther
/// than that from the solid.
///
/// The proof is `weights`: no ball that protrudes by `error` or less holds points of more than `mostInOneBall`
/// together, and `spheres` times that is less than the weight of all.
struct ErrorBound {
  std::uint32_t spheres = 0;           ///< the number of balls the bound is about
  double error = 0;                    ///< mesh unit; 0: nothing could be proved, and `weights` is empty
  std::vector<WeightedPoint> weights;  ///< sums stay below 2^64
  std::uint64_t mostInOneBall = 0;     ///< weight that one ball can hold at most
};

/// How hard `lowerErrorBound` tries.
struct BoundOptions {
  std::uint32_t points = 0;  ///< of the surface, to be covered; 0: chosen by the number of spheres; else 8..20000
};

/// Proves a lower bound of the error (worst protrusion) of any cover of the surface by `spheres` balls, whoever makes
/// it, by duality of fractional covers. Weak for many spheres: a fractional cover is cheaper than a cover. Errors tried
/// are fractions 2^(-k/64) of the bounding box's diagonal.
///
/// Precondition: `checkMesh(mesh)`. Fails for options out of range and with `kCancelled`. Parallel; the result does not
/// depend on the number of threads. See docs/algorithms/lower-bound.md.
Result<ErrorBound> lowerErrorBound(const TriangleMesh& mesh, std::uint32_t spheres, const BoundOptions& options = {},
                                   const ProgressCallback& progress = {});

}  // namespace cairn::builder
