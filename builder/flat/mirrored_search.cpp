// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/mirrored_search.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "balls/ball_fit.h"
#include "cover/holders.h"
#include "surface/infinity.h"

namespace cairn::builder {
namespace {

/// As in `optimiseLevel`: part of the worst stand-off a round first asks to save, and at least; sweeps of a round;
/// steps of a centre in parts of the stand-off asked for.
constexpr double kFirstAsked = 0.1, kMinAsked = 0.004;
constexpr int kMirrorSweeps = 3, kMirrorRounds = 60;
constexpr double kCoarseStep = 0.3, kFineStep = 0.01;

class MirroredOptimisation {
 public:
  MirroredOptimisation(const MirroredProblem& problem, const MirroredSet& start)
      : problem_(problem), every_(problem.points.size()), holders_(problem.points.size()) {
    std::iota(every_.begin(), every_.end(), 0U);
    // Pairs first, then those on the plane.
    take(start.pairs, problem.pairs, false);
    take(start.onPlane, problem.onPlane, true);
    costs_.resize(balls_.size());
    for (std::uint32_t i = 0; i < balls_.size(); ++i) update(i);
  }

  MirroredSet run() {
    double asked = kFirstAsked, worst = worstCost();
    for (int round = 0; round < kMirrorRounds && asked >= kMinAsked && worst > problem_.enough; ++round) {
      if (!problem_.keepGoing()) break;
      const SphereSet before = balls_;
      const double goal = std::max(problem_.enough, worst * (1 - asked));
      double reached = worst;
      for (int sweep = 0; sweep < kMirrorSweeps && reached > goal; ++sweep) {
        for (const std::uint32_t i : worstFirst()) move(i, goal);
        reached = worstCost();
      }
      if (reached >= worst) restore(before);
      if (reached > goal) asked *= 0.5;
      worst = std::min(worst, reached);
    }
    const auto first = balls_.begin() + static_cast<std::ptrdiff_t>(problem_.pairs);
    return {{balls_.begin(), first}, {first, balls_.end()}};
  }

 private:
  bool onPlane(std::size_t i) const { return i >= problem_.pairs; }

  /// So many of the balls, with more where they are too few.
  void take(const SphereSet& balls, std::size_t count, bool plane) {
    for (std::size_t i = 0; i < count; ++i) {
      Ball ball = i < balls.size() ? balls[i] : Ball{problem_.points[i * problem_.points.size() / count], 0, 0};
      balls_.push_back(placed(ball.center, plane));
    }
  }

  Ball placed(const Vec3d& center, bool plane) const {
    const Vec3d at = plane ? problem_.mirror.projected(center) : problem_.mirror.folded(center);
    return {at, 0, problem_.field.depth(at)};
  }

  void update(std::uint32_t i) {
    costs_[i].resize(every_.size());
    problem_.points.distances(balls_[i].center, balls_[i].depth, costs_[i]);
    holders_.update(i, every_, costs_[i], open_);
    for (const std::uint32_t p : open_) {
      Holder holder;
      for (std::uint32_t k = 0; k < balls_.size(); ++k)
        if (!costs_[k].empty()) holder.offer(k, costs_[k][p]);
      holders_.set(p, holder);
    }
  }

  void restore(const SphereSet& before) {
    balls_ = before;
    for (std::uint32_t i = 0; i < balls_.size(); ++i) update(i);
  }

  double worstCost() const { return *std::max_element(holders_.costs().begin(), holders_.costs().end()); }

  std::vector<std::uint32_t> worstFirst() const {
    std::vector<double> load(balls_.size(), -kInfinity);
    for (std::size_t p = 0; p < holders_.size(); ++p)
      load[holders_.balls()[p]] = std::max(load[holders_.balls()[p]], holders_.costs()[p]);
    std::vector<std::uint32_t> order(balls_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return load[a] > load[b]; });
    return order;
  }

  void move(std::uint32_t i, double goal) {
    holders_.duties(i, every_, costs_[i], goal, duties_);
    if (duties_.empty()) {
      const auto worst = static_cast<std::size_t>(std::max_element(holders_.costs().begin(), holders_.costs().end()) -
                                                  holders_.costs().begin());
      const Vec3d owner = balls_[holders_.balls()[worst]].center;
      balls_[i] = placed((problem_.points[worst] + owner) * 0.5, onPlane(i));
      update(i);
      return;
    }
    PointSet points;
    points.assign(problem_.points, duties_);
    if (onPlane(i))
      for (std::size_t p = 0, n = points.size(); p < n; ++p) points.push(problem_.mirror.reflected(points[p]));
    const double needed = points.farthest(balls_[i].center).distance - balls_[i].depth;
    const Ball start{balls_[i].center, needed + balls_[i].depth, balls_[i].depth};
    const Ball lowest = descend(start, points, problem_.field, kCoarseStep * goal, kFineStep * goal, memory_);
    const Ball ball = placed(lowest.center, onPlane(i));
    if (points.farthest(ball.center).distance - ball.depth >= needed) return;
    balls_[i] = ball;
    update(i);
  }

  const MirroredProblem& problem_;
  std::vector<std::uint32_t> every_;  // all points
  SphereSet balls_;
  std::vector<std::vector<double>> costs_;  // by ball, by point
  Holders holders_;
  std::vector<std::uint32_t> open_, duties_;  // of one move, kept for their memory
  StandOffMemory memory_;
};

}  // namespace

SphereSet MirroredSet::expanded(const Mirror& mirror) const {
  SphereSet all;
  for (const Ball& ball : pairs) {
    all.push_back(ball);
    all.push_back({mirror.reflected(ball.center), ball.radius, ball.depth});
  }
  all.insert(all.end(), onPlane.begin(), onPlane.end());
  return all;
}

MirroredSet mirroredSearch(const MirroredProblem& problem, MirroredSet start) {
  return MirroredOptimisation(problem, start).run();
}

}  // namespace cairn::builder
