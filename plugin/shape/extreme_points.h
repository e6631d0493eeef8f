// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Diagonal of the points' axis-aligned box. Precondition: `points` not empty.
float boxDiagonal(std::span<const Vec3> points);

/// The points of a mesh that can be extreme in some direction, packed for tight boxes at any rotation.
///
///     const ExtremePoints extremes(vertices);
///     const ExtremePoints::Interval interval = extremes.along(axis);
///
/// They are the vertices of a convex hull that Bullet computes on a grid of about 10,000 cells along each axis of the
/// box (btConvexHullComputer). A vertex can be missed by at most one cell's diagonal: that is `slack()`.
class ExtremePoints {
 public:
  /// Precondition: `points` not empty, finite. Cost: a convex hull, O(n log n).
  explicit ExtremePoints(std::span<const Vec3> points);

  /// All of the points: of a mesh that moves, a hull would take longer than it saves. `slack()` is rounding then.
  /// Linear. Precondition: `points` not empty, finite.
  static ExtremePoints all(std::span<const Vec3> points);

  struct Interval {
    float lower, upper;
  };
  /// Bounds `dot(direction, p)` over all points p. Precondition: `direction` is a unit vector. Cost: linear in the
  /// hull's vertices.
  Interval along(const Vec3& direction) const;

  /// Upper bound on the distance of any point from `from`, at most `slack()` too large.
  float radiusAround(const Vec3& from) const;
  /// Diagonal of the points' axis-aligned box.
  float diagonal() const { return diagonal_; }
  float slack() const { return slack_; }
  std::size_t memoryBytes() const { return sizeof *this + blocks_.capacity() * sizeof(Block); }

 private:
  static constexpr std::size_t kLanes = 8;
  ExtremePoints() = default;
  template <class PointAt>
  void pack(std::size_t count, const PointAt& pointAt);
  struct Block {
    std::array<float, kLanes> x, y, z;
  };

  std::vector<Block> blocks_;  // the last one is filled up with copies
  float diagonal_ = 0;
  float slack_ = 0;
};

}  // namespace cairn::bullet
