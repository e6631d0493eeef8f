// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/enclosing_ball.h"
#include "medial/hubbard_medial.h"

namespace cairn::builder {

/// Forming points of merged medial spheres, ascending by sample. The set caches the starting values of Ritter's ball.
class SampleSet {
 public:
  /// Precondition: `samples` is ascending and not empty.
  SampleSet(std::span<const std::uint32_t> samples, const HubbardMedial& medial);
  /// The union of two sets. Linear.
  SampleSet(const SampleSet& a, const SampleSet& b);
  SampleSet() = default;

  std::size_t size() const { return samples_.size(); }
  std::uint32_t sample(std::size_t i) const { return samples_[i]; }
  const Vec3d& point(std::size_t i) const { return points_[i]; }

  /// Returns the ball of `ritterBall` around the points.
  EnclosingBall ritterBall() const;
  /// The index of the point marked as the worst; 0 before `setWorst`.
  std::size_t worst() const { return worst_; }
  void setWorst(std::size_t i) { worst_ = i; }
  /// Returns `ritterBall` of the union without its last pass, which only widens the ball for rounding. The centre is
  /// the same, the radius is no larger. One pass over the points; the union is not built.
  friend EnclosingBall ritterBallOfBoth(const SampleSet& a, const SampleSet& b);

 private:
  /// By axis: the indices of the first lowest and of the last highest point.
  struct Extremes {
    std::array<std::uint32_t, 3> low{}, high{};
  };
  void findExtremes();
  static EnclosingBall start(const SampleSet& a, const SampleSet& b);
  /// Returns the index of the first point, from index `i` on, that is not well inside the ball.
  std::size_t nextOutside(std::size_t i, const EnclosingBall& ball) const;

  std::vector<std::uint32_t> samples_;
  std::vector<Vec3d> points_;
  Extremes extremes_;
  std::size_t worst_ = 0;
};

/// Hubbard's error of a ball around forming points (thesis Eq. 4.1, 4.2). It is the largest distance from a point,
/// along a normal of its clusters, to the ball's surface. Mesh unit.
class HubbardError {
 public:
  explicit HubbardError(const HubbardMedial& medial);

  double of(const EnclosingBall& ball, const SampleSet& samples) const;
  /// Marks the point of the set that decides the error of `ball`. Bounds for unions of the set examine this point
  /// first.
  void markWorst(const EnclosingBall& ball, SampleSet& samples) const;
  /// Returns a lower bound of `of` for the union's ball, from a few of the points.
  double atLeast(const SampleSet& a, const SampleSet& b) const;

 private:
  double ofPoint(const EnclosingBall& ball, const SampleSet& samples, std::size_t i) const;
  double raised(double worst, const EnclosingBall& ball, const SampleSet& samples, std::size_t step) const;

  std::vector<std::uint32_t> first_;  // by sample: the begin of its normals; at last the end of all
  std::vector<Vec3d> normals_;
};

/// Returns the error for one point in the ball: the distance along `normal` from `point` to the ball's surface.
double normalStandOff(const Vec3d& center, double radius, const Vec3d& point, const Vec3d& normal);

}  // namespace cairn::builder
