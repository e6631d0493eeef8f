// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/enclosing_ball.h"
#include "medial/hubbard_medial.h"

namespace cairn::builder {

/// Forming points of merged medial spheres, ascending by sample, with what Ritter's ball starts from kept ready.
class SampleSet {
 public:
  /// Precondition: `samples` ascending, not empty.
  SampleSet(std::span<const std::uint32_t> samples, const HubbardMedial& medial);
  /// The union. Linear.
  SampleSet(const SampleSet& a, const SampleSet& b);
  SampleSet() = default;

  std::size_t size() const { return samples_.size(); }
  std::uint32_t sample(std::size_t i) const { return samples_[i]; }
  const Vec3d& point(std::size_t i) const { return points_[i]; }

  /// The ball `ritterBall` finds around the points.
  EnclosingBall ritterBall() const;
  /// The point marked as the worst; the first unless told otherwise.
  std::size_t worst() const { return worst_; }
  void setWorst(std::size_t i) { worst_ = i; }
  /// `ritterBall` of the union without its last pass, which only widens the ball for rounding: same centre, no larger
  /// radius. One pass over the points; the union is not built.
  friend EnclosingBall ritterBallOfBoth(const SampleSet& a, const SampleSet& b);

 private:
  /// By axis: the places of the first of the lowest and of the last of the highest points.
  struct Extremes {
    std::array<std::uint32_t, 3> low{}, high{};
  };
  void findExtremes();
  static EnclosingBall start(const SampleSet& a, const SampleSet& b);
  /// The first point from place `i` on that is not well inside the ball.
  std::size_t nextOutside(std::size_t i, const EnclosingBall& ball) const;

  std::vector<std::uint32_t> samples_;
  std::vector<Vec3d> points_;
  Extremes extremes_;
  std::size_t worst_ = 0;
};

/// Hubbard's error of a ball around forming points (thesis Eq. 4.1, 4.2): the largest distance from one of them along a
/// normal of its clusters to the ball's surface. Mesh unit.
class HubbardError {
 public:
  explicit HubbardError(const HubbardMedial& medial);

  double of(const EnclosingBall& ball, const SampleSet& samples) const;
  /// Has the set remember which of its points decides the error of `ball`: bounds for its unions look there first.
  void markWorst(const EnclosingBall& ball, SampleSet& samples) const;
  /// No more than `of` for the union's ball, looking at a few of the points.
  double atLeast(const SampleSet& a, const SampleSet& b) const;

 private:
  double ofPoint(const EnclosingBall& ball, const SampleSet& samples, std::size_t i) const;
  double raised(double worst, const EnclosingBall& ball, const SampleSet& samples, std::size_t step) const;

  std::vector<std::uint32_t> first_;  // by sample: its normals' begin; and the end of all
  std::vector<Vec3d> normals_;
};

/// The error for one point in the ball: how far the ball stands off along `normal` above `point`.
double normalStandOff(const Vec3d& center, double radius, const Vec3d& point, const Vec3d& normal);

}  // namespace cairn::builder
