// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bodies.h"

namespace cairn::hard {

struct RollingStart {
  double radius = 0.5;          ///< metres
  double degrees = 10;          ///< of the slope
  double timeStep = 1.0 / 240;  ///< seconds
  btVector3 at{0, 0, 0};        ///< of the slope's plane, and of the ball on it
};

/// A ball let go on a plane that leans down along x, friction 1: its acceleration between a quarter and five quarters
/// of a second (at half a metre; in proportion to the root of the radius), over 5/7 g sin.
double rollDown(const test::TriedBody& ball, const RollingStart& start);

}  // namespace cairn::hard
