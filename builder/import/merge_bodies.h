// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// A mesh whose triangles know the body they come from.
struct LabelledMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> body;  ///< for each triangle; `kBead` for those of none
  std::size_t cutTriangles = 0;     ///< triangles of the source that were divided
  std::size_t foldedTriangles = 0;  ///< parts of triangles around which the source wound backwards
  std::size_t beads = 0;            ///< edges of more than two triangles that got a bead
};
inline constexpr std::uint32_t kBead = std::numeric_limits<std::uint32_t>::max();

/// How far surfaces that should meet are moved into each other, in tolerances: half a tolerance is many units of a
/// float.
inline constexpr double kRaised = 1.5;

/// The unit of floats at the farthest coordinate of each axis. Near the origin floats are finer, and rounding to them
/// would leave triangles that are nearly without area.
Vec3d unitsOf(const TriangleMesh& mesh);

/// Unites what overlaps or touches, in floats: the exact union is rounded, and united again where rounding made
/// triangles meet. Around edges at which solids only touch, a bead of this radius is laid, or of 32 of the largest unit
/// of floats. A mesh that needs nothing keeps its triangles. `hollowOf` is that of `BodiesOfMesh`. Preconditions and
/// failures are those of `unite`.
Result<LabelledMesh> mergeBodies(LabelledMesh source, const std::vector<std::uint32_t>& hollowOf, double beadRadius);

}  // namespace cairn::builder
