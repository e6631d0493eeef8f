// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/piece.h"
#include "balls/sphere_set.h"

namespace cairn::builder {

/// Grows balls until each piece, or each part of one that is cut, lies in one of them: what no ball holds is bisected
/// down to a longest edge of `finest`, then given to the ball that grows least by it. Centres stay. Balls times pieces,
/// and as much for each cut. Precondition: `balls` not empty, `finest` > 0.
void growToCover(SphereSet& balls, Pieces pieces, double finest);

}  // namespace cairn::builder
