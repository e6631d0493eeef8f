// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimise.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "spheres/ball_fit.h"

namespace cairn::builder {

namespace {

constexpr double kFirstRequest = 0.1;  ///< part of the worst stand-off a round first asks to save
constexpr double kSmallestRequest = 0.02;
constexpr int kSweepsPerRound = 3;
constexpr int kMaxRounds = 30;
/// First and finest step of a centre, in parts of the requested stand-off.
constexpr double kCoarsestStep = 0.3, kFinestStep = 0.01;

/// A ball that needs no more than this part of the requested stand-off stays where it is: it can wait for others'
/// points.
constexpr double kEase = 0.8;
/// A swap has to lower the stand-off by this factor to be kept.
constexpr double kWorthASwap = 0.998;

class Optimisation {
 public:
  Optimisation(const CoverProblem& problem, SphereSet balls)
      : problem_(problem), balls_(std::move(balls)), points_(problem.points.size()), costs_(balls_.size() * points_) {
    for (std::size_t i = 0; i < balls_.size(); ++i) updateCosts(i);
    while (balls_.size() < problem.count) {
      balls_.emplace_back();
      costs_.resize(balls_.size() * points_, std::numeric_limits<double>::infinity());
      joinWorst(balls_.size() - 1);
      updateCosts(balls_.size() - 1);
    }
  }

  SphereSet run() {
    double worst = worstCost();
    double request = kFirstRequest;
    for (int round = 0; round < kMaxRounds && request >= kSmallestRequest && worst > 0; ++round) {
      const SphereSet saved = balls_;
      const std::vector<double> savedCosts = costs_;
      const double goal = worst * (1 - request);
      double reached = worst;
      for (int s = 0; s < kSweepsPerRound && reached > goal; ++s) {
        sweep(goal);
        reached = worstCost();
      }
      if (reached >= worst) {
        balls_ = saved;
        costs_ = savedCosts;
      }
      if (reached > goal) request *= 0.5;
      worst = std::min(worst, reached);
    }
    return settled();
  }

 private:
  std::span<double> row(std::size_t ball) { return std::span(costs_).subspan(ball * points_, points_); }
  double cost(std::size_t ball, std::size_t point) const { return costs_[ball * points_ + point]; }

  void updateCosts(std::size_t i) { problem_.points.distances(balls_[i].center, balls_[i].depth, row(i)); }

  std::size_t cheapest(std::size_t point) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < balls_.size(); ++i)
      if (cost(i, point) < cost(best, point)) best = i;
    return best;
  }

  double worstCost() const {
    double worst = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < points_; ++p) worst = std::max(worst, cost(cheapest(p), p));
    return worst;
  }

  /// Points that no other ball holds at the stand-off `goal`, and that this one holds most cheaply.
  PointSet dutiesOf(std::size_t ball, double goal) const {
    PointSet duties;
    for (std::size_t p = 0; p < points_; ++p) {
      bool free = false;
      for (std::size_t i = 0; i < balls_.size() && !free; ++i)
        free = i != ball && (cost(i, p) <= goal || cost(i, p) < cost(ball, p));
      if (!free) duties.push(problem_.points[p]);
    }
    return duties;
  }

  void sweep(double goal) {
    std::vector<double> load(balls_.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t p = 0; p < points_; ++p) {
      const std::size_t i = cheapest(p);
      load[i] = std::max(load[i], cost(i, p));
    }
    std::vector<std::size_t> order(balls_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return load[a] > load[b]; });
    for (const std::size_t i : order) move(i, goal);
  }

  void move(std::size_t i, double goal) {
    const PointSet duties = dutiesOf(i, goal);
    if (duties.empty()) {
      joinWorst(i);
    } else {
      const Ball needed{balls_[i].center, duties.farthest(balls_[i].center).distance, balls_[i].depth};
      if (needed.standOff() <= kEase * goal) return;
      balls_[i] = descend(needed, duties, problem_.solid, kCoarsestStep * goal, kFinestStep * goal);
    }
    updateCosts(i);
  }

  /// An idle ball goes to the point that is covered worst, where it will take over its share.
  void joinWorst(std::size_t i) {
    std::size_t worst = 0;
    double worstCost = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < points_; ++p) {
      const double c = cost(cheapest(p), p);
      if (c > worstCost) {
        worstCost = c;
        worst = p;
      }
    }
    const std::size_t owner = cheapest(worst);
    const Vec3d center = (balls_[owner].center + problem_.points[worst]) * 0.5;
    balls_[i] = {center, 0, problem_.solid.depth(center)};
  }

  /// The balls with the radii they need for the points they hold most cheaply; idle ones are dropped.
  SphereSet settled() {
    std::vector<double> load(balls_.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t p = 0; p < points_; ++p) {
      const std::size_t i = cheapest(p);
      load[i] = std::max(load[i], cost(i, p));
    }
    SphereSet set;
    for (std::size_t i = 0; i < balls_.size(); ++i)
      if (load[i] > -std::numeric_limits<double>::infinity())
        set.push_back({balls_[i].center, load[i] + balls_[i].depth, balls_[i].depth});
    return set;
  }

  const CoverProblem& problem_;
  SphereSet balls_;
  std::size_t points_;
  std::vector<double> costs_;  // of ball i for point p at i * points_ + p
};

}  // namespace

SphereSet optimise(const CoverProblem& problem, SphereSet start) {
  return Optimisation(problem, std::move(start)).run();
}

SphereSet optimiseBySwaps(const CoverProblem& problem, SphereSet start, int rounds) {
  SphereSet best = optimise(problem, std::move(start));
  double standOff = coverStandOff(problem.points, best);
  bool improved = true;
  for (int round = 0; round < rounds && improved && standOff > 0; ++round) {
    improved = false;
    for (std::size_t i = 0; i < best.size() && !improved; ++i) {
      SphereSet fewer = best;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      SphereSet trial = optimise(problem, std::move(fewer));
      const double reached = coverStandOff(problem.points, trial);
      if (reached >= standOff * kWorthASwap) continue;
      improved = true;
      standOff = reached;
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace cairn::builder
