// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "balls/enclosing_ball.h"
#include "balls/stand_off.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

constexpr int kMaxEvaluations = 60;
/// A hull whose shortest vector is below this holds nearly opposing gradients: the centre is optimal at this step
/// length.
constexpr double kFlat = 0.02;
/// Fraction of a linear model's predicted decrease that a step must reach to count as one.
constexpr double kSufficient = 0.1;
constexpr double kGrow = 1.6, kShrink = 0.35;

/// Gradients seen around one centre, as structure of arrays: the loops over all of them are short and many.
class Bundle {
 public:
  void restart(const Vec3d& gradient) {
    size_ = 0;
    add(gradient);
    path_[0] = {gradient, kInfinity};
    end_ = 0;
  }
  bool full() const { return size_ == kMax; }
  void add(const Vec3d& gradient) {
    x_[size_] = gradient.x;
    y_[size_] = gradient.y;
    z_[size_] = gradient.z;
    ++size_;
  }

  /// The shortest vector of the gradients' convex hull (Gilbert 1966); a dozen rounds are ample for a direction. Call
  /// it after each `add`. It repeats the path of the last call up to the point where the new gradient leads elsewhere.
  Vec3d shortest() {
    std::size_t round = 0;
    for (const Vec3d added = at(size_ - 1); !(dot(path_[round].v, added) < path_[round].lowest); ++round)
      if (round == end_) return path_[end_].v;
    if (size_ == 1) return path_[0].v;
    for (;; ++round) {
      const Vec3d v = path_[round].v;
      end_ = round;
      if (round == kRounds) return v;
      const Vec3d lowest = at(lowestAlong(v)), edge = lowest - v;
      path_[round].lowest = dot(v, lowest);
      const double gain = -dot(v, edge), edgeSq = lengthSq(edge);
      if (gain <= 1e-12 || edgeSq == 0) return v;
      path_[round + 1] = {v + edge * std::min(1.0, gain / edgeSq), -kInfinity};
    }
  }

 private:
  static constexpr std::size_t kMax = 8, kRounds = 12;

  /// A vector of the hull on the path to the shortest one, and the least dot product of a gradient with it.
  struct Stop {
    Vec3d v;
    double lowest = 0;
  };

  Vec3d at(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

  std::size_t lowestAlong(const Vec3d& v) const {
    std::array<double, kMax> along;
    for (std::size_t i = 0; i < kMax; ++i) along[i] = x_[i] * v.x + y_[i] * v.y + z_[i] * v.z;
    std::size_t lowest = 0;
    double least = along[0];
    for (std::size_t i = 1; i < size_; ++i) {
      lowest = along[i] < least ? i : lowest;
      least = std::min(least, along[i]);
    }
    return lowest;
  }

  std::array<double, kMax> x_{}, y_{}, z_{};
  std::size_t size_ = 0;
  std::array<Stop, kRounds + 1> path_;  // valid up to `end_`; after the last round no gradient leads elsewhere
  std::size_t end_ = 0;
};

}  // namespace

Ball ballAround(const Vec3d& center, const PointSet& points, const DepthField& solid) {
  return {center, points.farthest(center).distance, solid.depth(center)};
}

Ball descend(const Ball& start, const PointSet& points, const DepthField& solid, double coarsest, double finest,
             StandOffMemory& memory) {
  assert(start.depth == solid.depth(start.center) && finest > 0);
  StandOff standOff(points, solid, memory);
  StandOff::Value best = standOff.at(start.center, start.depth);
  Bundle bundle;
  bundle.restart(best.gradient);
  double step = coarsest;
  for (int evaluations = 1; evaluations < kMaxEvaluations && step >= finest; ++evaluations) {
    const Vec3d direction = bundle.shortest();
    const double slope = length(direction);
    if (slope < kFlat) {
      step *= kShrink;
      bundle.restart(best.gradient);
      continue;
    }
    const StandOff::Value trial = standOff.near(best, step, best.ball.center - direction * (step / slope));
    const double gain = best.ball.standOff() - trial.ball.standOff();
    if (gain > kSufficient * step * slope) {
      best = trial;
      bundle.restart(trial.gradient);
      step *= kGrow;
    } else if (bundle.full()) {
      step *= kShrink;
      bundle.restart(best.gradient);
    } else {
      bundle.add(trial.gradient);
      // A gradient that opposes no other gradient gives no information: the step was too long.
      if (dot(trial.gradient, direction) > 0.5 * slope * slope) step *= kShrink;
    }
  }
  return best.ball;
}

Ball fitBall(const Vec3d& center, const PointSet& points, const DepthField& solid) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  const Ball smallest = ballAround(smallestEnclosingBall(list).center, points, solid);
  const Ball around = ballAround(center, points, solid);
  const Ball& start = smallest.standOff() < around.standOff() ? smallest : around;
  if (start.radius == 0) return start;  // a single point; no step improves its ball
  StandOffMemory memory;
  return descend(start, points, solid, 0.2 * start.radius, 1e-4 * start.radius, memory);
}

}  // namespace cairn::builder
