// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

/// 2 sin(t/2) for the angle t between two rotations: the Frobenius norm of their difference, divided by the root of
/// two. Going from one rotation to the other moves points at unit distance from the centre by at most this.
inline btScalar chordBetween(const btMatrix3x3& x, const btMatrix3x3& y) {
  btScalar sum = 0;
  for (int row = 0; row < 3; ++row) sum += (x[row] - y[row]).length2();
  return std::sqrt(sum / 2);
}

/// Pose of the tree in the other body's frame, with the ball that holds the tree. It measures how far a pair has moved:
///
///     if (now.displacementSince(before) <= skin) reuse();
struct RelativePlacement {
  btTransform treeInOther = btTransform::getIdentity();  ///< of the tree's body, in the other body's frame
  btVector3 center{0, 0, 0};                             ///< of the ball, in the tree body's frame
  btScalar radius = 0;                                   ///< world length, > 0

  /// Bound (world length, rounding included) on the movement of any point of the tree against the other body since
  /// `before`. It is the movement of the ball's centre, plus the chord of the rotation times the radius.
  btScalar displacementSince(const RelativePlacement& before) const {
    const btScalar turned = chordBetween(treeInOther.getBasis(), before.treeInOther.getBasis());
    const btVector3 now = treeInOther * center, then = before.treeInOther * center;
    // A transform's products and sums: a few units in the last place of the lengths that enter.
    constexpr btScalar kRounding = btScalar(16) * SIMD_EPSILON;
    const btScalar rounding = kRounding * (treeInOther.getOrigin().length() + center.length() + radius);
    return (now - then).length() + turned * radius + rounding;
  }
};

}  // namespace cairn::bullet
