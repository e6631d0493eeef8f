// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/vec3.h"
#include "oracle/chain_of_balls.h"

namespace cairn::hard {

/// A matrix in extended precision.
struct WideMatrix {
  Wide rows[3];
  explicit WideMatrix(const Mat3d& m) : rows{Wide(m.rows[0]), Wide(m.rows[1]), Wide(m.rows[2])} {}
  Wide operator*(const Wide& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  /// The x for which `*this * x = v`: floats are no exact rotation, so the transpose would not do.
  Wide solved(const Wide& v) const {
    const long double volume = dot(rows[0], cross(rows[1], rows[2]));
    return (cross(rows[1], rows[2]) * v.x + cross(rows[2], rows[0]) * v.y + cross(rows[0], rows[1]) * v.z) / volume;
  }
};

}  // namespace cairn::hard
