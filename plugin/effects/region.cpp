// SPDX-License-Identifier: Zlib
#include "cairn/effects/region.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace cairn::effects {

Region::Region(std::vector<Point> corners) : corners_(std::move(corners)) {
  assert(corners_.size() >= 3);
  lower_ = upper_ = corners_.front();
  for (const Point& corner : corners_) {
    lower_ = {std::min(lower_.x, corner.x), std::min(lower_.y, corner.y)};
    upper_ = {std::max(upper_.x, corner.x), std::max(upper_.y, corner.y)};
  }
}

bool Region::contains(btScalar x, btScalar y) const {
  if (isEverywhere()) return true;
  if (x < lower_.x || x > upper_.x || y < lower_.y || y > upper_.y) return false;
  bool isInside = false;
  for (std::size_t i = 0, before = corners_.size() - 1; i < corners_.size(); before = i++) {
    const Point &a = corners_[i], &b = corners_[before];
    if ((a.y > y) != (b.y > y) && x < (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x) isInside = !isInside;
  }
  return isInside;
}

}  // namespace cairn::effects
