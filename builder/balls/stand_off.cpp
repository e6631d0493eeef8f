// SPDX-License-Identifier: GPL-3.0-or-later
#include "stand_off.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace cairn::builder {

namespace {

/// With more parts than this, a search of the field is equally fast.
constexpr std::size_t kMaxParts = 256;
/// Kept points and parts are filtered again when the reach has shrunk by this factor.
constexpr double kNarrow = 0.6;

StandOff::Value valueOf(const Vec3d& center, double radius, const Vec3d& farthest, const DepthField::Sample& sample) {
  return {{center, radius, sample.depth}, directionFrom(farthest, center) - sample.rise};
}

}  // namespace

StandOff::Value StandOff::at(const Vec3d& center, double depth) const {
  const PointSet::Farthest farthest = points_.farthest(center);
  return valueOf(center, farthest.distance, points_[farthest.index], solid_.at(center, depth, 0));
}

StandOff::Value StandOff::near(const Value& around, double reach, const Vec3d& center) {
  if (!known_ || around.ball.center != around_) {
    around_ = around.ball.center;
    known_ = true;
    reach_ = 0;
  }
  if (reach > reach_)
    gather(around, reach);
  else if (reach < kNarrow * reach_)
    narrow(around, reach);
  const PointSet::Farthest farthest = memory_.farPoints.farthest(center);
  const double moved = distance(center, around_);
  return valueOf(
      center, farthest.distance, memory_.farPoints[farthest.index],
      partsKept_ ? solid_.atAmong(memory_.parts, center, moved) : solid_.at(center, around.ball.depth, moved));
}

void StandOff::gather(const Value& around, double reach) {
  radius_ = around.ball.radius;
  memory_.farDistances.resize(points_.size());
  points_.distances(around_, 0, memory_.farDistances);
  keepFar(points_, reach);
  gatherParts(around.ball.depth, reach);
  reach_ = reach;
}

void StandOff::narrow(const Value& around, double reach) {
  keepFar(memory_.farPoints, reach);
  reach_ = reach;
  if (!partsKept_) {
    gatherParts(around.ball.depth, reach);
    return;
  }
  const double within = decided_ + 2 * reach;
  std::erase_if(memory_.parts, [&](const DepthField::Part& part) { return part.distance > within; });
}

void StandOff::keepFar(const PointSet& points, double reach) {
  // For every centre within reach, a point nearer than this is nearer than the farthest one.
  const double nearest = (radius_ - 2 * reach) - kRoundingRoom * radius_;
  std::vector<double>& distances = memory_.farDistances;
  std::vector<std::uint32_t>& kept = memory_.kept;
  kept.resize(distances.size());
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < distances.size(); ++i) {
    const double d = distances[i];
    distances[count] = d;
    kept[count] = i;
    count += d < nearest ? 0 : 1;
  }
  distances.resize(count);
  kept.resize(count);
  memory_.farPoints.assign(points, kept);
}

void StandOff::gatherParts(double depth, double reach) {
  const std::optional<double> within = solid_.gather(around_, depth, reach, kMaxParts, memory_.parts);
  partsKept_ = within.has_value();
  decided_ = within.value_or(0) - 2 * reach;
  // The nearest part goes first, so that most others can be skipped.
  if (partsKept_ && !memory_.parts.empty())
    std::iter_swap(memory_.parts.begin(), std::ranges::min_element(memory_.parts, {}, &DepthField::Part::distance));
}

}  // namespace cairn::builder
