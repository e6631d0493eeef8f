// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/core/vec3.h"

namespace cairn {

/// A tree's pose in the world: `world = rotation * (scale * p) + translation`. It is in double precision, so that
/// relative poses keep float accuracy far from the world's origin. Precondition: rotation orthonormal, scale > 0.
struct Pose {
  Mat3d rotation;     ///< from the tree's axes to the world's
  Vec3d translation;  ///< world units
  double scale = 1;   ///< world length per tree unit

  /// Places a point of the tree's frame in the world.
  Vec3d operator*(const Vec3d& p) const { return rotation * (p * scale) + translation; }
};

/// A rotation, uniform scale and translation in one: `to = linear * from + translation`, lengths times `scale`.
struct Similarity {
  Mat3 linear;       ///< scale times rotation
  Vec3 translation;  ///< in the unit of the frame it maps to
  float scale = 1;   ///< of lengths

  /// Maps a point.
  Vec3 operator*(const Vec3& p) const { return linear * p + translation; }
};

/// Maps points of the body at `from` into the frame and length unit of the body at `to`. Computed in double, rounded
/// once.
CAIRN_CORE_EXPORT Similarity relativePose(const Pose& to, const Pose& from);

}  // namespace cairn
