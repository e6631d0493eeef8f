// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A ball of a level's cut. Mesh frame and unit.
struct CutBall {
  Vec3d center;
  double radius = 0;

  bool contains(const Vec3d& p) const { return lengthSq(p - center) <= radius * radius; }
};

}  // namespace cairn::builder
