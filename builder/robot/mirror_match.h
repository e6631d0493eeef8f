// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A mesh that is another one, mirrored in coordinate planes or not.
struct MirrorMatch {
  Vec3d signs{1, 1, 1};  ///< 1 or -1 for each axis
  double deviation = 0;  ///< no point of a surface is farther from the other, mirrored one; mesh unit
};

/// Vertices of two files count as the same up to this fraction of the bounding box's diagonal: what exporters round,
/// printing six or seven digits.
inline constexpr double kMirrorMatchTolerance = 1e-6;

/// Whether `mesh` is `other` with its axes turned round by some signs: the same triangles between the same vertices.
/// The signs with the fewest minus are tried first. Nothing where it is not. O(n log n).
std::optional<MirrorMatch> mirrorMatch(const TriangleMesh& mesh, const TriangleMesh& other);

/// The mesh mirrored by signs; triangles are turned where the number of minus signs is odd.
TriangleMesh mirrored(TriangleMesh mesh, const Vec3d& signs);

}  // namespace cairn::builder
