// SPDX-License-Identifier: Zlib
#include "continuous/lateral_separation.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

// The point nearest to the origin on the side between two corners.
Vec3 nearestOfSide(const Vec3& a, const Vec3& b) {
  const Vec3 side = b - a;
  return a + side * std::clamp(-dot(a, side) / lengthSq(side), 0.0F, 1.0F);
}

}  // namespace

bool LateralSeparation::add(const Vec3& point) {
  for (std::size_t i = 0; i < count_; ++i)
    if (lengthSq(corners_[i] - point) == 0) return false;
  corners_[count_++] = point;
  return true;
}

bool LateralSeparation::surroundsOrigin() const {
  const float ab = crossAlong(corners_[0], corners_[1]), bc = crossAlong(corners_[1], corners_[2]),
              ca = crossAlong(corners_[2], corners_[0]);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

Vec3 LateralSeparation::nearestToOrigin() {
  if (count_ == 1) return corners_[0];
  if (count_ == 2) return nearestOfSide(corners_[0], corners_[1]);
  if (surroundsOrigin()) return {};
  // The origin is beyond one of the newest corner's sides: it was on this side of the other two.
  const Vec3 newest = corners_[2];
  const Vec3 toFirst = nearestOfSide(corners_[0], newest), toSecond = nearestOfSide(corners_[1], newest);
  const bool isFirst = lengthSq(toFirst) < lengthSq(toSecond);
  corners_ = {isFirst ? corners_[0] : corners_[1], newest};
  count_ = 2;
  return isFirst ? toFirst : toSecond;
}

}  // namespace cairn::bullet
