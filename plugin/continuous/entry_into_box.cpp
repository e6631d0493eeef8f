// SPDX-License-Identifier: Zlib
#include "continuous/entry_into_box.h"

#include <algorithm>

namespace cairn::bullet {

std::optional<float> entryIntoBox(const Vec3& lower, const Vec3& upper, const Vec3& point, const Vec3& displacement) {
  float from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (displacement[axis] == 0) {
      if (point[axis] < lower[axis] || point[axis] > upper[axis]) return std::nullopt;
      continue;
    }
    const float one = (lower[axis] - point[axis]) / displacement[axis],
                other = (upper[axis] - point[axis]) / displacement[axis];
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  if (from > to) return std::nullopt;
  return from;
}

}  // namespace cairn::bullet
