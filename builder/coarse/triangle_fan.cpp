// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse/triangle_fan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::builder {
namespace {

/// A triangle may turn by 78 degrees in a collapse. More, and it soon lies upon its neighbour.
constexpr double kMinCosine = 0.2;
/// The least height over its longest side at which a triangle has a direction, as a part of that side.
constexpr double kMinHeight = 1e-6;

constexpr std::size_t kWidth = TrianglePacket::kWidth;

Vec3d areaOf(const std::array<Vec3d, 3>& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

double longestSq(const std::array<Vec3d, 3>& t) {
  return std::max({lengthSq(t[1] - t[0]), lengthSq(t[2] - t[1]), lengthSq(t[0] - t[2])});
}

/// Where new triangles are looked at: halfway along their sides, and around their middles.
std::array<Vec3d, 7> looksAt(const std::array<Vec3d, 3>& t) {
  const auto& [a, b, c] = t;
  const Vec3d middle = (a + b + c) / 3.0;
  return {(a + b) * 0.5,      (b + c) * 0.5,      (c + a) * 0.5,     middle,
          (a + middle) * 0.5, (b + middle) * 0.5, (c + middle) * 0.5};
}

}  // namespace

void TriangleFan::clear() {
  triangles_.clear();
  packets_.clear();
}

bool TriangleFan::add(const std::array<Vec3d, 3>& before, const std::array<Vec3d, 3>& after) {
  const Vec3d was = areaOf(before), is = areaOf(after);
  const double area = length(is);
  if (!(area > kMinHeight * longestSq(after)) || !(dot(was, is) > kMinCosine * length(was) * area)) return false;
  const std::size_t lane = triangles_.size() % kWidth;
  if (lane == 0) packets_.emplace_back();
  packets_.back().set(static_cast<int>(lane), static_cast<std::uint32_t>(triangles_.size()), after);
  triangles_.push_back(after);
  return true;
}

double TriangleFan::distanceSq(std::size_t triangle, const Vec3d& point) const {
  return lengthSq(packets_[triangle / kWidth].nearest(static_cast<int>(triangle % kWidth), point).offset);
}

std::size_t TriangleFan::nearest(const Vec3d& point) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const double sq = distanceSq(i, point);
    if (sq >= least) continue;
    least = sq;
    nearest = i;
  }
  return nearest;
}

std::optional<double> TriangleFan::distanceTo(const SurfaceDistance& source, std::span<const Vec3d> points,
                                              double limit) const {
  const double limitSq = limit * limit;
  double worstSq = 0;
  for (const Vec3d& point : points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles_.size() && least > worstSq; ++i)
      least = std::min(least, distanceSq(i, point));
    worstSq = std::max(worstSq, least);
    if (worstSq >= limitSq) return {};
  }
  double worst = std::max(std::sqrt(worstSq), source.closest(triangles_.front().front()).distance);
  if (worst >= limit) return {};
  for (const std::array<Vec3d, 3>& triangle : triangles_)
    for (const Vec3d& point : looksAt(triangle)) {
      worst = std::max(worst, source.closest(point).distance);
      if (worst >= limit) return {};
    }
  return worst;
}

void keepSpread(std::vector<Vec3d>& points, std::size_t most) {
  if (points.size() <= most) return;
  std::vector<double> away(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t kept = 1; kept < most; ++kept) {
    std::size_t farthest = kept;
    for (std::size_t i = kept; i < points.size(); ++i) {
      away[i] = std::min(away[i], lengthSq(points[i] - points[kept - 1]));
      if (away[i] > away[farthest]) farthest = i;
    }
    std::swap(points[kept], points[farthest]);
    std::swap(away[kept], away[farthest]);
  }
  points.resize(most);
}

}  // namespace cairn::builder
