// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/signed_distance.h"
#include "volumes/overlap.h"

namespace cairn::bench {

/// A lower and an upper bound of the least signed distance from a solid to a surface, mesh unit; negative inside.
struct Gap {
  double lower = 0, upper = 0;
};

/// Measures the gap between a solid and a mesh placed by `move`, by branch and bound over the mesh's triangles. The two
/// bounds differ by at most `tolerance` or half of the upper one.
Gap surfaceGap(const builder::SignedDistance& solid, const builder::TriangleMesh& mesh, const RigidMove& move,
               double tolerance);

/// Poses of a second body of the same mesh beside the first, in which surfaces cross, at most `tolerance` deep. Each is
/// turned at random and has moved along a random direction, with some point of its surface towards some point of the
/// first one's. Only the meshes decide, no volumes. Same seed, same poses.
std::vector<RigidMove> touchingPoses(const builder::SignedDistance& solid, std::size_t count, std::uint64_t seed,
                                     double tolerance);

/// The move the other way.
RigidMove inverseOf(const RigidMove& move);

}  // namespace cairn::bench
