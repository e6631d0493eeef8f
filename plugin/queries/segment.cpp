// SPDX-License-Identifier: Zlib
#include "queries/segment.h"

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

Segment::Segment(const Vec3d& from, const Vec3d& to, double slack) : slack_(static_cast<float>(slack)) {
  const Vec3d displacement = to - from;
  length_ = length(displacement);
  if (!(length_ > 0) || !std::isfinite(length_) || !std::isfinite(lengthSq(from))) return;
  const Vec3d along = displacement / length_;
  start_ = dot(from, along);
  origin_ = Vec3(from - along * start_);
  direction_ = Vec3(along);
  begin_ = static_cast<float>(start_) - slack_;
  isSane_ = true;
}

namespace {

// Dead lanes are at infinity, where arithmetic would raise exceptions, so they move to a place where squares stay
// finite.
constexpr float kDeadLane = 1e18F;

}  // namespace

Entries entriesOf(const Segment& segment, const Family& family, std::uint32_t livingLanes, float end) {
  const Vec3 o = segment.origin(), d = segment.direction();
  const float begin = segment.begin();
  Entries entries;
  std::uint32_t met[kFamilyWidth];
  for (std::uint32_t i = 0; i < kFamilyWidth; ++i) {
    const float x = std::min(family.x[i], kDeadLane) - o.x, y = std::min(family.y[i], kDeadLane) - o.y,
                z = std::min(family.z[i], kDeadLane) - o.z;
    const float along = x * d.x + y * d.y + z * d.z;
    const float px = x - along * d.x, py = y - along * d.y, pz = z - along * d.z;
    const float radius = family.radius[i] + segment.slack();
    const float halfSq = radius * radius - (px * px + py * py + pz * pz);
    const float half = std::sqrt(std::max(halfSq, 0.0F));
    entries.at[i] = std::max(along - half, begin);
    met[i] = static_cast<std::uint32_t>(halfSq >= 0) & static_cast<std::uint32_t>(along + half >= begin) &
             static_cast<std::uint32_t>(entries.at[i] <= end);
  }
  for (std::uint32_t i = 0; i < kFamilyWidth; ++i) entries.lanes |= met[i] << i;
  entries.lanes &= livingLanes;
  return entries;
}

}  // namespace cairn::bullet
