// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/enclosing_ball.h"

namespace cairn::builder {

/// Returns a ball that holds the points, by Ritter's two passes (Graphics Gems, 1990). The widest of three axis-extreme
/// pairs spans the first ball. The ball then grows towards every point outside. It is typically 5 to 20 % wider than
/// the smallest ball. Hubbard's construction is defined with it. Linear. Precondition: `points` is not empty.
EnclosingBall ritterBall(std::span<const Vec3d> points);

}  // namespace cairn::builder
