// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/farthest_sample.h"

namespace cairn::builder {

/// Points as a structure of arrays, for loops that measure many distances from one centre.
class PointSet {
 public:
  PointSet() = default;
  explicit PointSet(std::span<const Vec3d> points);

  std::size_t size() const { return x_.size(); }
  bool empty() const { return x_.empty(); }
  Vec3d operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  void clear();
  void push(const Vec3d& point);
  /// Replaces the set by the points of `from` at the indices `which`. `from` may be this set itself. Precondition:
  /// `which` is ascending.
  void assign(const PointSet& from, std::span<const std::uint32_t> which);

  struct Farthest {
    double distance = 0;
    std::size_t index = 0;
  };
  /// Returns the point farthest from `center`, the lowest index on a tie. Precondition: the set is not empty. Linear.
  Farthest farthest(const Vec3d& center) const;
  /// Returns the index of the point farthest along `direction`, the lowest on a tie. Precondition: the set is not
  /// empty. Linear.
  std::size_t farthestAlong(const Vec3d& direction) const;
  /// True when some point lies within `reach` of `center`. Linear; ends at the first such point.
  bool anyWithin(const Vec3d& center, double reach) const;
  /// Writes the distance of every point from `center`, minus `offset`. Precondition: `out.size() == size()`.
  void distances(const Vec3d& center, double offset, std::span<double> out) const;

 private:
  std::vector<double> x_, y_, z_;
};

/// `farthestPointSample` of a set.
PointSet evenSample(const PointSet& points, std::size_t count, std::size_t first);

}  // namespace cairn::builder
