// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/enclosing_ball.h"

namespace cairn::builder {

/// A ball that holds the points, by Ritter's two passes (Graphics Gems, 1990): the widest of three axis-extreme pairs
/// spans the first ball, which then grows towards every point outside. Typically 5 to 20 % wider than the smallest; it
/// is here because Hubbard's construction is made of it. Linear. Precondition: not empty.
EnclosingBall ritterBall(std::span<const Vec3d> points);

}  // namespace cairn::builder
