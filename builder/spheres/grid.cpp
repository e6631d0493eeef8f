// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "balls/ball_fit.h"
#include "cover/downhill_simplex.h"
#include "spheres/oriented_grid.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

/// Factor from one size of cells to the next (Alg. 1).
constexpr double kShrink = 0.9;
/// The search also ends when cells are this fraction of the first ones. In a rod's region few points are left to cover
/// long before. The number of a block's cells then stays far below 2^64.
constexpr double kMinPart = 1e-3;
/// For each start of a search. The thesis names no number; the author's program allows as many.
constexpr std::size_t kEvaluations = 100;
/// First steps of the search: a fraction of a cell along its axes, and radians about them.
constexpr double kFirstMove = 0.5, kFirstTurn = 0.2;
/// Number of times that the points are shared out anew among the moved balls.
constexpr int kSharings = 3;

using Shares = std::vector<std::vector<Vec3d>>;

std::vector<Vec3d> listOf(const PointSet& points) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return list;
}

/// The points that each cell's ball was kept for.
Shares sharesOf(const OrientedGrid& grid, const std::vector<Vec3d>& centers, const std::vector<Vec3d>& points) {
  Shares shares(centers.size());
  for (const Vec3d& p : points) {
    std::size_t home = 0;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      if (distance(p, centers[i]) < distance(p, centers[home])) home = i;
      if (distance(p, centers[i]) > grid.ballRadius()) continue;
      home = i;
      break;
    }
    shares[home].push_back(p);
  }
  return shares;
}

/// The points, each with the ball that holds it at the least stand-off.
Shares sharesOf(const SphereSet& set, const std::vector<Vec3d>& points) {
  Shares shares(set.size());
  for (const Vec3d& p : points) {
    std::size_t home = 0;
    for (std::size_t i = 1; i < set.size(); ++i)
      if (costOf(set[i], p) < costOf(set[home], p)) home = i;
    shares[home].push_back(p);
  }
  return shares;
}

/// Returns the balls of least stand-off for the shares, found from `centers`. Balls without points are dropped.
SphereSet fitted(const Shares& shares, const std::vector<Vec3d>& centers, const DepthField& solid) {
  SphereSet set;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (!shares[i].empty()) set.push_back(fitBall(centers[i], PointSet(shares[i]), solid));
  return set;
}

double worstStandOff(const SphereSet& set) {
  double worst = -kInfinity;
  for (const Ball& ball : set) worst = std::max(worst, ball.standOff());
  return worst;
}

/// Returns the set that covers the points from the grid's cells at the worst stand-off found.
SphereSet movedBalls(const OrientedGrid& grid, const std::vector<Vec3d>& cells, const std::vector<Vec3d>& points,
                     const DepthField& solid) {
  SphereSet set = fitted(sharesOf(grid, cells, points), cells, solid);
  for (int sharing = 0; sharing < kSharings; ++sharing) {
    std::vector<Vec3d> centers;
    for (const Ball& ball : set) centers.push_back(ball.center);
    SphereSet next = fitted(sharesOf(set, points), centers, solid);
    if (worstStandOff(next) >= worstStandOff(set)) break;
    set = std::move(next);
  }
  return set;
}

class Search {
 public:
  explicit Search(const std::vector<Vec3d>& points) : points_(points), principal_(principalGrid(points)) {
    for (const Vec3d& p : points) pivot_ += p / static_cast<double>(points.size());
  }

  const OrientedGrid& principal() const { return principal_; }

  /// Returns the grid of the given size with the best metric. The search starts from the last grid and from the points'
  /// own box.
  OrientedGrid best(OrientedGrid last, double edge) const {
    OrientedGrid own = principal_;
    last.edge = own.edge = edge;
    if (coverByGrid(last, points_).centers.size() == 1) return last;
    const auto fromLast = found(last), fromOwn = found(own);
    return fromOwn.value < fromLast.value ? moved(own, fromOwn.at, pivot_) : moved(last, fromLast.at, pivot_);
  }

 private:
  SimplexOptimum<6> found(const OrientedGrid& start) const {
    return downhillSimplex<6>(
        {}, {kFirstMove, kFirstMove, kFirstMove, kFirstTurn, kFirstTurn, kFirstTurn}, kEvaluations,
        [&](const std::array<double, 6>& x) { return -coverByGrid(moved(start, x, pivot_), points_).metric; });
  }

  const std::vector<Vec3d>& points_;
  OrientedGrid principal_;
  Vec3d pivot_;
};

}  // namespace

SphereSet gridSpheres(const CoverProblem& problem) {
  assert(!problem.points.empty());
  const std::vector<Vec3d> points = listOf(problem.points);
  const Search search(points);
  OrientedGrid grid = search.principal();
  SphereSet best = movedBalls(grid, coverByGrid(grid, points).centers, points, problem.solid);
  assert(best.size() == 1);
  const double least = kMinPart * grid.edge;
  for (double edge = grid.edge * kShrink; edge > least; edge *= kShrink) {
    grid = search.best(grid, edge);
    const std::vector<Vec3d> cells = coverByGrid(grid, points).centers;
    if (cells.size() > problem.count) break;
    SphereSet set = movedBalls(grid, cells, points, problem.solid);
    if (set.size() > 1 && (best.size() == 1 || worstStandOff(set) < worstStandOff(best))) best = std::move(set);
  }
  return best;
}

}  // namespace cairn::builder
