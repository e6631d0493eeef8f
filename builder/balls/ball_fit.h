// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/depth_field.h"
#include "balls/point_set.h"
#include "balls/stand_off.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// Returns the smallest ball around `center` that holds the points. Cost: one distance query and one pass over the
/// points. Precondition: `points` is not empty.
Ball ballAround(const Vec3d& center, const PointSet& points, const DepthField& solid);

/// Lowers the stand-off max |p - c| - s(c) by moves of the centre from `start`. `coarsest` is the first step; the
/// descent ends when steps shorter than `finest` no longer help. Never returns a worse ball than the one around
/// `start`.
///
/// The function is not smooth: it has a kink wherever the farthest point or the nearest face changes. Each step
/// therefore goes along the shortest vector in the hull of the gradients seen near the current centre. This vector is a
/// descent direction for all of them (bundle method; Lemarechal 1975). Typical cost: 20 to 60 evaluations, each with
/// one distance query and one pass over the points.
///
/// Preconditions: `start.depth` is the depth of its centre; 0 < `finest` <= `coarsest`. `memory` is reused from one
/// descent to the next.
Ball descend(const Ball& start, const PointSet& points, const DepthField& solid, double coarsest, double finest,
             StandOffMemory& memory);

/// Takes the better of the ball around `center` and the smallest enclosing ball (thesis 5.3.2), then calls `descend`.
///
///     Ball ball = fitBall(region.center(), points, SolidDepth(distance));
Ball fitBall(const Vec3d& center, const PointSet& points, const DepthField& solid);

}  // namespace cairn::builder
