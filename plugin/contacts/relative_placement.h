// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

/// Where the tree stands, seen from the other body, and the ball that holds it.
struct RelativePlacement {
  btTransform treeInOther = btTransform::getIdentity();  ///< of the tree's body, in the other body's frame
  btVector3 center{0, 0, 0};                             ///< of the ball, in the tree body's frame
  btScalar radius = 0;                                   ///< world length, > 0

  /// World length by which no point of the tree has moved more against the other body since it stood at `before`,
  /// rounding included. The ball's centre moves by a length; turning by an angle t about it moves what it holds by at
  /// most 2 sin(t/2) radii, which is the Frobenius norm of the difference of the rotations over the root of two.
  btScalar displacementSince(const RelativePlacement& before) const {
    btScalar turnedSq = 0;
    for (int row = 0; row < 3; ++row)
      turnedSq += (treeInOther.getBasis()[row] - before.treeInOther.getBasis()[row]).length2();
    const btVector3 now = treeInOther * center, then = before.treeInOther * center;
    // Products and sums of a transform, a few units in the last place of the lengths that go in.
    constexpr btScalar kRounding = btScalar(16) * SIMD_EPSILON;
    const btScalar rounding = kRounding * (treeInOther.getOrigin().length() + center.length() + radius);
    return (now - then).length() + std::sqrt(turnedSq / 2) * radius + rounding;
  }
};

}  // namespace cairn::bullet
