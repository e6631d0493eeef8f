// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// At most `count` of the points, spread evenly: starts with point `first`, then takes the one farthest from those
/// taken, the lowest index on a tie. Keeps the extremes of a cluster, which a random choice would lose (Gonzalez 1985).
/// The points are kept in small boxes, and only boxes near the last one taken are looked at: n log n to sort them, then
/// about count times the number of boxes, n / 64. Same result as looking at every point.
std::vector<Vec3d> farthestPointSample(std::span<const Vec3d> points, std::size_t count, std::size_t first);

}  // namespace cairn::builder
