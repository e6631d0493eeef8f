// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// The points x with dot(normal, x) <= offset. `normal` has length 1.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;

  double heightOf(const Vec3d& x) const { return dot(normal, x) - offset; }
};

}  // namespace cairn::builder
