// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/piece.h"
#include "balls/sphere_set.h"

namespace cairn::builder {

/// Grows balls until each piece, or each part of a piece that was cut, lies in one of them. A piece in no ball is
/// bisected down to a longest edge of `finest`. Then the ball that grows least takes it. Centres stay. Cost: balls
/// times pieces, and as much for each cut. Preconditions: `balls` is not empty, `finest` > 0.
void growToCover(SphereSet& balls, Pieces pieces, double finest);

}  // namespace cairn::builder
