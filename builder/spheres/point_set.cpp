// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace cairn::builder {

PointSet::PointSet(std::span<const Vec3d> points) {
  for (const Vec3d& p : points) push(p);
}

void PointSet::clear() {
  x_.clear();
  y_.clear();
  z_.clear();
}

void PointSet::push(const Vec3d& point) {
  x_.push_back(point.x);
  y_.push_back(point.y);
  z_.push_back(point.z);
}

PointSet::Farthest PointSet::farthest(const Vec3d& center) const {
  assert(!empty());
  // Four running maxima hide the latency of the comparison; the second pass finds the index.
  double best[4] = {-1, -1, -1, -1};
  const auto distanceSq = [&](std::size_t i) {
    const double dx = x_[i] - center.x, dy = y_[i] - center.y, dz = z_[i] - center.z;
    return dx * dx + dy * dy + dz * dz;
  };
  std::size_t i = 0;
  for (; i + 4 <= size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) {
      const double d = distanceSq(i + k);
      best[k] = d > best[k] ? d : best[k];
    }
  for (; i < size(); ++i) best[0] = std::max(best[0], distanceSq(i));
  const double farthestSq = std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
  std::size_t index = 0;
  while (distanceSq(index) != farthestSq) ++index;
  return {std::sqrt(farthestSq), index};
}

bool PointSet::anyWithin(const Vec3d& center, double reach) const {
  // Roots are taken only where rounding might matter.
  constexpr double kSlack = 1e-12;
  const double surelySq = reach * reach * (1 - kSlack), perhapsSq = reach * reach * (1 + kSlack);
  for (std::size_t i = 0; i < size(); ++i) {
    const double dx = x_[i] - center.x, dy = y_[i] - center.y, dz = z_[i] - center.z;
    const double distanceSq = dx * dx + dy * dy + dz * dz;
    if (distanceSq > perhapsSq) continue;
    if (distanceSq <= surelySq || std::sqrt(distanceSq) <= reach) return true;
  }
  return false;
}

void PointSet::distances(const Vec3d& center, double offset, std::span<double> out) const {
  assert(out.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    const double dx = x_[i] - center.x, dy = y_[i] - center.y, dz = z_[i] - center.z;
    out[i] = std::sqrt(dx * dx + dy * dy + dz * dz) - offset;
  }
}

std::vector<Vec3d> cornersOf(std::span<const Piece> pieces) {
  std::vector<Vec3d> corners;
  corners.reserve(pieces.size() * 3);
  for (const Piece& piece : pieces) corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
  std::sort(corners.begin(), corners.end(),
            [](const Vec3d& a, const Vec3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace cairn::builder
