// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Which pieces that need more than the stand-off are cut.
enum class Cutting : std::uint8_t {
  always,       ///< all: trees keep the bytes that they always had
  whereItHelps  ///< not those of which a corner alone makes their ball grow as far. Else a sphere that all but lies on
                ///< a round part of the surface has that part cut to dust, without end in memory
};

/// Divides a region among balls (thesis 6.1): part i of the result must lie in ball i.
///
/// A piece goes to the ball that holds it at the least stand-off. Two balls meet on the surface where both would need
/// the same stand-off, |p - c1| - s(c1) = |p - c2| - s(c2). This surface moves towards the larger ball, like the
/// refined dividing planes of the thesis. A piece that would need more than `standOff` is bisected down to a longest
/// edge of `finest`, so that seams cost almost nothing. Then the cheapest ball takes it and has to grow. The parts
/// cover exactly the area of `pieces`.
///
/// `bias` (one length for each ball) moves the seams. Of the balls that hold a piece within `standOff`, the one with
/// the least stand-off plus bias takes it. Preconditions: `balls` is not empty, `finest` > 0.
std::vector<Pieces> divide(Pieces pieces, std::span<const Ball> balls, std::span<const double> bias, double standOff,
                           double finest, Cutting cutting = Cutting::always);

}  // namespace cairn::builder
