// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/depth_field.h"
#include "balls/point_set.h"
#include "balls/stand_off.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// The ball around `center` that just holds the points. One distance query. Precondition: `points` not empty.
Ball ballAround(const Vec3d& center, const PointSet& points, const DepthField& solid);

/// Moves the centre downhill on the stand-off, that is max |p - c| - s(c), from `start` until steps shorter than
/// `finest` no longer help; `coarsest` is the first step. Never returns a worse ball than the one around `start`.
///
/// The function is not smooth (it has a kink wherever the farthest point or the nearest face changes), so each step
/// goes along the shortest vector of the hull of the gradients seen near the current centre, which is a descent
/// direction of all of them (bundle method; Lemarechal 1975). Typically 20 to 60 evaluations of one distance query and
/// one pass over the points each. Preconditions: `start.depth` is that of its centre; 0 < `finest` <= `coarsest`.
/// `memory` is kept from one descent to the next.
Ball descend(const Ball& start, const PointSet& points, const DepthField& solid, double coarsest, double finest,
             StandOffMemory& memory);

/// The tightest of the ball around `center` and the smallest enclosing ball (thesis 5.3.2), then `descend`.
Ball fitBall(const Vec3d& center, const PointSet& points, const DepthField& solid);

}  // namespace cairn::builder
