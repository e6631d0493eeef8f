// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "cairn/builder/certify_balls.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// How closely a largest distance is enclosed: until upper <= lower * (1 + relative) + absolute, or, in a solid, until
/// so many cubes were looked at (then the bounds are as valid, only farther apart).
struct LeftOutTolerance {
  double relative = 0.01;
  double absolute = 0;  ///< mesh unit
  std::size_t maxCubes = 400'000;
};

/// The largest distance from a point of the surface to the nearest ball; an upper bound of 0 is a proof of cover, for
/// which triangles are cut down to `kMinPiece` of the diagonal. Parallel over triangles, deterministic.
/// Precondition: `balls` not empty.
EnclosedDistance surfaceLeftOut(std::span<const Ball> balls, const TriangleMesh& mesh,
                                const LeftOutTolerance& tolerance, const KeepGoing& keepGoing);

/// The largest distance from a point of the solid to the nearest ball, `surface` being that of its surface. Best first
/// over cubes of an octree, one thread. Precondition: `balls` not empty.
EnclosedDistance solidLeftOut(std::span<const Ball> balls, const SignedDistance& solid, const EnclosedDistance& surface,
                              const LeftOutTolerance& tolerance, const KeepGoing& keepGoing);

}  // namespace cairn::builder
