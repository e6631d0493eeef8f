// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Divides a region among balls by planes, as the thesis does (6.1, Alg. 8): part i of the result lies in ball i, as
/// far as the balls hold the pieces. `divide` is Cairn's own way.
///
/// Between two balls that overlap stands one plane, perpendicular to the line through their centres. It begins where
/// the two surfaces meet. Then it moves along that line so that both balls get as equal numbers of pieces as they can.
/// So the smaller ball gets more of what both hold. A piece belongs to a ball that holds it and on whose side of the
/// planes its centroid lies; only planes to balls that also hold the piece count. With three balls a piece may be on
/// the wrong side of each. Such a piece goes to the ball that holds it deepest.
///
/// A piece that no ball holds is bisected down to a longest edge of `finest`. Then the ball that grows least for it
/// takes it. The parts cover exactly the area of `pieces`. Preconditions: `balls` is not empty, `finest` > 0. Cost: for
/// each two balls one pass over the pieces, and a sort of those that both hold.
std::vector<Pieces> divideByPlanes(Pieces pieces, std::span<const Ball> balls, double finest);

}  // namespace cairn::builder
