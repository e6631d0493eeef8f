// SPDX-License-Identifier: Zlib
#include "stem_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn::effects {

StemGrid::StemGrid(const std::vector<SingleTrees::Stem>& stems, const GroundHeight& ground, btScalar height) {
  for (const SingleTrees::Stem& stem : stems) {
    const std::optional<btScalar> foot = ground.at(stem.x, stem.y);
    const btScalar tall = stem.height > 0 ? stem.height : height;
    if (foot && tall > 0) stems_.push_back({stem.x, stem.y, stem.diameter, *foot + tall});
  }
  if (!stems_.empty()) sortIntoCells();
}

void StemGrid::sortIntoCells() {
  lowerX_ = upperX_ = stems_.front().x;
  lowerY_ = upperY_ = stems_.front().y;
  for (const Standing& stem : stems_) {
    lowerX_ = std::min(lowerX_, stem.x);
    lowerY_ = std::min(lowerY_, stem.y);
    upperX_ = std::max(upperX_, stem.x);
    upperY_ = std::max(upperY_, stem.y);
    greatestRadius_ = std::max(greatestRadius_, stem.diameter / 2);
  }
  const btScalar x = upperX_ - lowerX_, y = upperY_ - lowerY_, count = static_cast<btScalar>(stems_.size());
  // No more than three cells a stem, even if all stand in a line.
  width_ = std::max({std::sqrt(x * y / count), x / count, y / count, btScalar(1)});
  columns_ = static_cast<std::size_t>(x / width_) + 1;
  rows_ = static_cast<std::size_t>(y / width_) + 1;
  const auto cellOf = [&](const Standing& stem) {
    return cellsBetween(stem.y, stem.y, lowerY_, rows_).first * columns_ +
           cellsBetween(stem.x, stem.x, lowerX_, columns_).first;
  };
  std::ranges::stable_sort(stems_, {}, cellOf);
  firstOf_.assign(columns_ * rows_ + 1, 0);
  for (const Standing& stem : stems_) ++firstOf_[cellOf(stem) + 1];
  std::partial_sum(firstOf_.begin(), firstOf_.end(), firstOf_.begin());
}

StemGrid::Cells StemGrid::cellsBetween(btScalar lower, btScalar upper, btScalar origin, std::size_t count) const {
  const auto cell = [&](btScalar at) {
    const btScalar cells = (at - origin) / width_;
    return cells > 0 ? std::min(static_cast<std::size_t>(std::min(cells, static_cast<btScalar>(count))), count - 1)
                     : std::size_t(0);
  };
  return {cell(lower), cell(upper) + 1};
}

// Where on its way, seen from above, the ball is nearest to the axis, there it must be below the top.
bool StemGrid::touches(const Standing& stem, const btVector3& from, const btVector3& to, btScalar radius) {
  const btScalar wayX = to.x() - from.x(), wayY = to.y() - from.y(), square = wayX * wayX + wayY * wayY;
  const btScalar along = (stem.x - from.x()) * wayX + (stem.y - from.y()) * wayY;
  const btScalar part = square > 0 ? std::clamp(along / square, btScalar(0), btScalar(1)) : btScalar(0);
  const btVector3 nearest = from + (to - from) * part;
  if (nearest.z() - radius >= stem.top) return false;
  const btScalar x = nearest.x() - stem.x, y = nearest.y() - stem.y, reach = radius + stem.diameter / 2;
  return x * x + y * y <= reach * reach;
}

void StemGrid::touchedBy(const btVector3& from, const btVector3& to, btScalar radius,
                         std::vector<std::uint32_t>& touched) const {
  const btScalar reach = radius + greatestRadius_;
  const btScalar lowerX = std::min(from.x(), to.x()) - reach, upperX = std::max(from.x(), to.x()) + reach;
  const btScalar lowerY = std::min(from.y(), to.y()) - reach, upperY = std::max(from.y(), to.y()) + reach;
  // Written so that what is not a number is outside.
  if (stems_.empty() || !(lowerX <= upperX_ && upperX >= lowerX_ && lowerY <= upperY_ && upperY >= lowerY_)) return;
  const Cells columns = cellsBetween(lowerX, upperX, lowerX_, columns_);
  const Cells rows = cellsBetween(lowerY, upperY, lowerY_, rows_);
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    const std::size_t first = firstOf_[row * columns_ + columns.first];
    const std::size_t end = firstOf_[row * columns_ + columns.end];
    for (std::size_t i = first; i < end; ++i)
      if (touches(stems_[i], from, to, radius)) touched.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace cairn::effects
