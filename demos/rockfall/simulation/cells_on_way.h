// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// The column or row of square cells, or the place in a row of them, that a coordinate lies in.
inline std::int32_t cellOf(double coordinate, double cell) {
  return static_cast<std::int32_t>(std::floor(coordinate / cell));
}

/// Calls `use(column, row)` for each cell that a straight way enters after its first one, in order. Cells and points
/// are in one unit. Source: Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987.
template <class Use>
void forEachCellEntered(const MapPoint& from, const MapPoint& to, double cell, const Use& use) {
  std::array<std::int32_t, 2> at{}, last{}, forward{};
  std::array<double, 2> next{}, each{};  // parts of the way: to the next border, and from border to border
  for (std::size_t axis = 0; axis < 2; ++axis) {
    at[axis] = cellOf(from[axis], cell);
    last[axis] = cellOf(to[axis], cell);
    forward[axis] = last[axis] > at[axis] ? 1 : -1;
    next[axis] = each[axis] = std::numeric_limits<double>::infinity();
    if (last[axis] == at[axis]) continue;
    const double way = to[axis] - from[axis];
    each[axis] = cell / std::abs(way);
    next[axis] = (cell * (at[axis] + (forward[axis] > 0 ? 1 : 0)) - from[axis]) / way;
  }
  // Their number is certain, whatever rounding does to the order of two borders near a corner.
  for (std::int32_t left = std::abs(last[0] - at[0]) + std::abs(last[1] - at[1]); left > 0; --left) {
    const bool isAlongX = at[1] == last[1] || (at[0] != last[0] && next[0] < next[1]);
    const std::size_t axis = isAlongX ? 0 : 1;
    at[axis] += forward[axis];
    next[axis] += each[axis];
    use(at[0], at[1]);
  }
}

}  // namespace cairn::rockfall
