// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn {

/// How a cloud of points moved: p -> to + scale * (rotation * (p - from)).
struct LocalMotion {
  Vec3d from, to;
  Mat3d rotation;
  double scale = 1;

  Vec3d operator()(const Vec3d& p) const { return to + rotation * (p - from) * scale; }
};

/// The rotation nearest to a matrix, by Newton's iteration for its polar factor: sums, products and quotients only, so
/// the same bits everywhere. The unit matrix for one that is singular or mirrors.
Mat3d nearestRotation(const Mat3d& m);

/// Adds the outer product of two vectors.
inline void addOuter(Mat3d& m, const Vec3d& column, const Vec3d& row) {
  m.rows[0] += row * column.x;
  m.rows[1] += row * column.y;
  m.rows[2] += row * column.z;
}

}  // namespace cairn
