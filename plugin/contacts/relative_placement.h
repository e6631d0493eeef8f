// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

/// 2 sin(t/2) for the angle t between two rotations, by which turning from one to the other moves points at unit
/// distance from the centre at most: the Frobenius norm of their difference over the root of two.
inline btScalar chordBetween(const btMatrix3x3& x, const btMatrix3x3& y) {
  btScalar sum = 0;
  for (int row = 0; row < 3; ++row) sum += (x[row] - y[row]).length2();
  return std::sqrt(sum / 2);
}

/// Where the tree stands, seen from the other body, and the ball that holds it.
struct RelativePlacement {
  btTransform treeInOther = btTransform::getIdentity();  ///< of the tree's body, in the other body's frame
  btVector3 center{0, 0, 0};                             ///< of the ball, in the tree body's frame
  btScalar radius = 0;                                   ///< world length, > 0

  /// World length by which no point of the tree has moved more against the other body since it stood at `before`,
  /// rounding included. The ball's centre moves by a length, and turning about it moves what it holds by that chord.
  btScalar displacementSince(const RelativePlacement& before) const {
    const btScalar turned = chordBetween(treeInOther.getBasis(), before.treeInOther.getBasis());
    const btVector3 now = treeInOther * center, then = before.treeInOther * center;
    // Products and sums of a transform, a few units in the last place of the lengths that go in.
    constexpr btScalar kRounding = btScalar(16) * SIMD_EPSILON;
    const btScalar rounding = kRounding * (treeInOther.getOrigin().length() + center.length() + radius);
    return (now - then).length() + turned * radius + rounding;
  }
};

}  // namespace cairn::bullet
