// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Balls by index, and what is asked of a convex piece and them: which can be nearest to a point of it, and how far its
/// points are from the nearest at most. Keeps a reference to the balls.
class BallDistances {
 public:
  BallDistances(std::span<const Ball> balls, const Bounds& bounds);

  using Names = std::vector<std::uint32_t>;
  const Names& all() const { return all_; }

  /// |p - c| - r of the nearest of the balls named: negative inside one.
  double nearest(const Vec3d& point, std::span<const std::uint32_t> among) const;
  /// Replaces `near` by those of `among` that can be nearest to a point within `reach` of `point`; returns what
  /// `nearest` does.
  double gather(const Vec3d& point, double reach, std::span<const std::uint32_t> among, Names& near) const;
  /// No point of the hull of the corners is farther from the nearest of the balls named; convexity puts the farthest
  /// from one ball at a corner.
  double most(std::span<const Vec3d> corners, std::span<const std::uint32_t> among) const;

  /// No distance computed here, nor a coordinate halved some fifty times, is off by more (mesh unit).
  double guard() const { return guard_; }

 private:
  std::span<const Ball> balls_;
  Names all_;
  double guard_ = 0;
};

}  // namespace cairn::builder
