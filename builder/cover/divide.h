// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Gives every part of a region to one ball (thesis 6.1): part i of the result is what ball i has to hold.
///
/// A piece goes to the ball that holds it at the least stand-off. Where two balls meet that is the surface on which
/// both would need the same stand-off, |p - c1| - s(c1) = |p - c2| - s(c2), which moves towards the larger ball as the
/// refined dividing planes of the thesis do. A piece that would need more than `standOff` is bisected, so that seams
/// cost almost nothing, down to a longest edge of `finest`; then the cheapest ball takes it and has to grow. The parts
/// cover exactly what `pieces` covered.
///
/// `bias` (as many as balls, lengths) moves the seams: among the balls that hold a piece within `standOff`, the one
/// with the least stand-off plus bias takes it. Precondition: `balls` not empty, `finest` > 0.
std::vector<Pieces> divide(Pieces pieces, std::span<const Ball> balls, std::span<const double> bias, double standOff,
                           double finest);

}  // namespace cairn::builder
