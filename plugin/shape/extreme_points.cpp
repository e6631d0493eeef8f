// SPDX-License-Identifier: Zlib
#include "shape/extreme_points.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "cairn/core/family.h"

namespace cairn::bullet {

namespace {

// btConvexHullComputer's grid has 10,216 cells along an axis. The rest covers its rounding and ours.
constexpr float kHullGridCell = 1.0F / 10000;

std::vector<std::uint32_t> hullVertices(std::span<const Vec3> points) {
  btConvexHullComputer hull;
  hull.compute(&points[0].x, sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  std::vector<std::uint32_t> indices;
  for (int i = 0; i < hull.original_vertex_index.size(); ++i)
    indices.push_back(static_cast<std::uint32_t>(hull.original_vertex_index[i]));
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

}  // namespace

float boxDiagonal(std::span<const Vec3> points) {
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  return length(upper - lower);
}

ExtremePoints::ExtremePoints(std::span<const Vec3> points)
    : diagonal_(boxDiagonal(points)), slack_(diagonal_ * kHullGridCell) {
  assert(!points.empty());
  const std::vector<std::uint32_t> hull = hullVertices(points);
  assert(!hull.empty());
  pack(hull.size(), [&](std::size_t i) { return points[hull[i]]; });
}

ExtremePoints ExtremePoints::all(std::span<const Vec3> points) {
  ExtremePoints extremes;
  extremes.diagonal_ = boxDiagonal(points);
  extremes.slack_ = extremes.diagonal_ * kOverlapSlack;
  extremes.pack(points.size(), [&](std::size_t i) { return points[i]; });
  return extremes;
}

template <class PointAt>
void ExtremePoints::pack(std::size_t count, const PointAt& pointAt) {
  blocks_.resize((count + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < blocks_.size() * kLanes; ++i) {
    const Vec3 p = pointAt(std::min(i, count - 1));
    Block& block = blocks_[i / kLanes];
    block.x[i % kLanes] = p.x;
    block.y[i % kLanes] = p.y;
    block.z[i % kLanes] = p.z;
  }
}

ExtremePoints::Interval ExtremePoints::along(const Vec3& direction) const {
  std::array<float, kLanes> lower, upper;
  lower.fill(std::numeric_limits<float>::max());
  upper.fill(std::numeric_limits<float>::lowest());
  for (const Block& block : blocks_)
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float s = direction.x * block.x[i] + direction.y * block.y[i] + direction.z * block.z[i];
      lower[i] = s < lower[i] ? s : lower[i];
      upper[i] = s > upper[i] ? s : upper[i];
    }
  return {*std::min_element(lower.begin(), lower.end()) - slack_,
          *std::max_element(upper.begin(), upper.end()) + slack_};
}

float ExtremePoints::radiusAround(const Vec3& from) const {
  float farthestSq = 0;
  for (const Block& block : blocks_)
    for (std::size_t i = 0; i < kLanes; ++i)
      farthestSq = std::max(farthestSq, lengthSq(Vec3(block.x[i], block.y[i], block.z[i]) - from));
  return std::sqrt(farthestSq) + slack_;
}

}  // namespace cairn::bullet
