// SPDX-License-Identifier: Zlib
#include "continuous/side_by_side.h"

namespace cairn::bullet {

bool SideBySide::add(const Vec3& point) {
  for (std::size_t i = 0; i < count_; ++i)
    if (lengthSq(corners_[i] - point) == 0) return false;
  corners_[count_++] = point;
  return true;
}

// Of two corners, the newer one last.
Vec3 SideBySide::nearestOfSide() {
  const Vec3 side = corners_[1] - corners_[0];
  const float part = -dot(corners_[0], side) / lengthSq(side);
  if (part > 0 && part < 1) return corners_[0] + side * part;
  if (part >= 1) corners_[0] = corners_[1];
  count_ = 1;
  return corners_[0];
}

Vec3 SideBySide::nearestToOrigin() {
  if (count_ == 1) return corners_[0];
  if (count_ == 2) return nearestOfSide();
  const Vec3 a = corners_[0], b = corners_[1], newest = corners_[2];
  const float ab = turn(a, b), bn = turn(b, newest), na = turn(newest, a);
  if ((ab >= 0 && bn >= 0 && na >= 0) || (ab <= 0 && bn <= 0 && na <= 0)) return {};
  // The origin is beyond one of the newest corner's sides: it was on this side of the other two.
  SideBySide withA(along_), withB(along_);
  withA.corners_ = {a, newest};
  withB.corners_ = {b, newest};
  withA.count_ = withB.count_ = 2;
  const Vec3 toA = withA.nearestOfSide(), toB = withB.nearestOfSide();
  const bool isA = lengthSq(toA) < lengthSq(toB);
  corners_ = isA ? withA.corners_ : withB.corners_;
  count_ = isA ? withA.count_ : withB.count_;
  return isA ? toA : toB;
}

}  // namespace cairn::bullet
