// SPDX-License-Identifier: Zlib
#include "queries/swept_box.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Least slope of the path along an axis. Slower boxes count as this fast, so that the division stays finite; the error
// is far below the slack.
constexpr float kMinSlope = 1e-7F;

float inverseOf(float slope) {
  return 1 / std::copysign(std::max(std::abs(slope), kMinSlope), slope);
}

}  // namespace

SweptBox::SweptBox(const Segment& path, const Vec3& halfExtent)
    : path_(path),
      half_(halfExtent + Vec3(path.slack(), path.slack(), path.slack())),
      inverse_(inverseOf(path.direction().x), inverseOf(path.direction().y), inverseOf(path.direction().z)) {}

float SweptBox::entryOf(const Vec3& lower, const Vec3& upper, float end) const {
  float entry = path_.begin(), exit = end;
  for (int axis = 0; axis < 3; ++axis) {
    const float toLower = (lower[axis] - half_[axis] - path_.origin()[axis]) * inverse_[axis];
    const float toUpper = (upper[axis] + half_[axis] - path_.origin()[axis]) * inverse_[axis];
    entry = std::max(entry, std::min(toLower, toUpper));
    exit = std::min(exit, std::max(toLower, toUpper));
  }
  return entry <= exit ? entry : std::numeric_limits<float>::infinity();
}

Entries SweptBox::entriesOf(const Family& family, std::uint32_t livingLanes, float end) const {
  Entries entries;
  for (std::uint32_t lanes = livingLanes; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
    const Sphere s = family.sphere(lane);
    const Vec3 reach(s.radius, s.radius, s.radius);
    entries.at[lane] = entryOf(s.center - reach, s.center + reach, end);
    if (entries.at[lane] <= end) entries.lanes |= 1U << lane;
  }
  return entries;
}

}  // namespace cairn::bullet
