// SPDX-License-Identifier: GPL-3.0-or-later
#include "spawn.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "balls/ball_fit.h"
#include "balls/enclosing_ball.h"
#include "cover/downhill_simplex.h"

namespace cairn::builder {

namespace {

/// Halvings of the stand-off's interval: they give 0.1 % of the stand-off of one ball alone.
constexpr int kBisections = 10;
constexpr std::size_t kSpawnEvaluations = 40;
/// First step of a centre, as a fraction of its first radius: far enough to leave the points held already.
constexpr double kFirstStep = 0.5;

/// Grows a set of balls of one stand-off.
class Growth {
 public:
  Growth(const CoverProblem& problem, double standOff)
      : problem_(problem), standOff_(standOff), uncovered_(problem.points) {}

  /// Returns nothing when the problem's count does not suffice.
  std::optional<SphereSet> run() {
    while (!uncovered_.empty()) {
      Ball best;
      std::size_t most = 0;
      for (const Ball& old : set_) {
        const Ball spawned = grownFrom(old.center);
        const std::size_t held = heldBy(spawned);
        if (held <= most) continue;
        best = spawned;
        most = held;
      }
      if (set_.size() == problem_.count) return std::nullopt;
      add(most > 0 ? best : grownFrom(uncovered_[0]));
    }
    return std::move(set_);
  }

 private:
  Ball ballAt(const Vec3d& center) const {
    const double depth = problem_.solid.depth(center);
    return {center, standOff_ + depth, depth};
  }

  std::size_t heldBy(const Ball& ball) const {
    if (ball.radius <= 0) return 0;
    std::size_t count = 0;
    for (std::size_t p = 0; p < uncovered_.size(); ++p) count += costOf(ball, uncovered_[p]) <= standOff_ ? 1 : 0;
    return count;
  }

  Ball grownFrom(const Vec3d& start) const {
    const double step = kFirstStep * std::max(ballAt(start).radius, standOff_);
    const auto optimum = downhillSimplex<3>({start.x, start.y, start.z}, {step, step, step}, kSpawnEvaluations,
                                            [&](const std::array<double, 3>& c) {
                                              return -static_cast<double>(heldBy(ballAt({c[0], c[1], c[2]})));
                                            });
    return ballAt({optimum.at[0], optimum.at[1], optimum.at[2]});
  }

  void add(const Ball& ball) {
    PointSet left;
    for (std::size_t p = 0; p < uncovered_.size(); ++p)
      if (costOf(ball, uncovered_[p]) > standOff_) left.push(uncovered_[p]);
    uncovered_ = std::move(left);
    set_.push_back(ball);
  }

  const CoverProblem& problem_;
  double standOff_;
  PointSet uncovered_;
  SphereSet set_;
};

/// The smallest enclosing ball, whose stand-off is enough for one.
Ball startingBall(const PointSet& points, const DepthField& solid) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return ballAround(smallestEnclosingBall(list).center, points, solid);
}

}  // namespace

SphereSet spawn(const CoverProblem& problem) {
  assert(!problem.points.empty());
  SphereSet best{startingBall(problem.points, problem.solid)};
  double enough = best.front().standOff(), tooLittle = 0;
  for (int i = 0; i < kBisections && tooLittle < enough; ++i) {
    const double standOff = 0.5 * (tooLittle + enough);
    if (std::optional<SphereSet> grown = Growth(problem, standOff).run()) {
      best = *std::move(grown);
      enough = standOff;
    } else {
      tooLittle = standOff;
    }
  }
  return best;
}

}  // namespace cairn::builder
