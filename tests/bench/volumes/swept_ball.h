// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cairn/core/vec3.h"

namespace cairn::bench {

/// By the number of directions in which the ball is swept.
enum class VolumeKind : std::uint8_t { ball, capsule, slab, box };
inline constexpr std::size_t kVolumeKinds = 4;

/// All points within `radius` of the *core*: a point, a segment, a rectangle or a box. Convex. Mesh
/// frame and unit.
struct SweptBall {
  VolumeKind kind = VolumeKind::ball;
  Vec3d center;  ///< middle of the core
  /// Orthonormal; the core lies along the first `dimensions()`, and no other is looked at.
  std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::array<double, 3> half{};  ///< half the core's extents; 0 beyond `dimensions()`
  double radius = 0;

  int dimensions() const { return static_cast<int>(kind); }

  /// The point of the core that is nearest to `p`, exact up to rounding.
  Vec3d nearestOnCore(const Vec3d& p) const {
    Vec3d nearest = center;
    for (int i = 0; i < dimensions(); ++i) nearest += axes[i] * std::clamp(dot(p - center, axes[i]), -half[i], half[i]);
    return nearest;
  }
  /// A point of the core's frame.
  Vec3d onCore(const std::array<double, 3>& along) const {
    return center + axes[0] * along[0] + axes[1] * along[1] + axes[2] * along[2];
  }
  double distanceToCore(const Vec3d& p) const { return distance(p, nearestOnCore(p)); }
  /// A ball around `center` that holds the volume.
  double reach() const { return std::hypot(half[0], half[1], half[2]) + radius; }
};

/// Bytes of a volume in floats: centre and radius, and one vector for each direction of the sweep.
constexpr std::size_t storedBytes(VolumeKind kind) {
  return sizeof(float) * (4 + 3 * static_cast<std::size_t>(kind));
}

/// What a pair test of two volumes of one kind costs, in tests of two balls (mixed code): rounded from what
/// `volumes_bench` measures (its first table). Fixed, so that trees are the same on every machine.
inline constexpr std::array<double, kVolumeKinds> kPairCost{1, 4, 9, 12};

}  // namespace cairn::bench
