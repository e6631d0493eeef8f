// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Returns at most `count` of the points, spread evenly. The first is point `first`; each next one is the point
/// farthest from those already taken, the lowest index on a tie. This keeps the extremes of a cluster, which a random
/// choice would lose (Gonzalez 1985). The result equals that of a search through all points.
///
/// Points are kept in small boxes, and only boxes near the last taken point are searched. Cost: n log n to sort them,
/// then about `count` times the number of boxes, n / 64.
std::vector<Vec3d> farthestPointSample(std::span<const Vec3d> points, std::size_t count, std::size_t first);

}  // namespace cairn::builder
