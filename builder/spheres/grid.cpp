// SPDX-License-Identifier: GPL-3.0-or-later
#include "grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "balls/enclosing_ball.h"
#include "balls/farthest_sample.h"
#include "cover/downhill_simplex.h"
#include "spheres/oriented_grid.h"

namespace cairn::builder {

namespace {

/// Factor from one size of cells to the next (Alg. 1).
constexpr double kShrink = 0.9;
/// The search ends when this many sizes needed too many balls. The need is no monotone function of the size, because
/// the search at one size may end badly.
constexpr int kMaxMisses = 2;
/// The search also ends when cells are this fraction of the first ones. In a rod's region few points are left to cover
/// long before. The number of a block's cells then stays far below 2^64.
constexpr double kMinPart = 1e-3;
constexpr std::size_t kEvaluations = 60;
/// First steps of the search: a fraction of a cell along its axes, and radians about them.
constexpr double kFirstMove = 0.25, kFirstTurn = 0.3;
/// The search sees this number of points. All points then decide which balls are needed.
constexpr std::size_t kSearchPoints = 60;

std::vector<Vec3d> listOf(const PointSet& points) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return list;
}

/// Returns the smallest balls around the points that each cell's ball was kept for. They hold all points.
SphereSet ballsOf(const OrientedGrid& grid, const std::vector<Vec3d>& points, const DepthField& solid) {
  const std::vector<Vec3d> centers = coverByGrid(grid, points).centers;
  std::vector<std::vector<Vec3d>> shares(centers.size());
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
  SphereSet set;
  for (const std::vector<Vec3d>& share : shares) {
    if (share.empty()) continue;
    const EnclosingBall smallest = smallestEnclosingBall(share);
    set.push_back({smallest.center, smallest.radius, solid.depth(smallest.center)});
  }
  return set;
}

double worstStandOff(const SphereSet& set) {
  double worst = -std::numeric_limits<double>::infinity();
  for (const Ball& ball : set) worst = std::max(worst, ball.standOff());
  return worst;
}

struct Search {
  explicit Search(const CoverProblem& problem)
      : points(listOf(problem.points)),
        few(farthestPointSample(points, kSearchPoints, 0)),
        principal(principalGrid(points)) {
    for (const Vec3d& p : points) pivot += p / static_cast<double>(points.size());
  }

  /// Returns the grid of the given size with the best metric. The search starts from the last grid and from the points'
  /// own box.
  OrientedGrid best(OrientedGrid last, double edge) const {
    OrientedGrid own = principal;
    last.edge = own.edge = edge;
    if (coverByGrid(last, few).centers.size() == 1) return last;
    const auto found = [&](const OrientedGrid& start) {
      return downhillSimplex<6>(
          {}, {kFirstMove, kFirstMove, kFirstMove, kFirstTurn, kFirstTurn, kFirstTurn}, kEvaluations,
          [&](const std::array<double, 6>& x) { return -coverByGrid(moved(start, x, pivot), few).metric; });
    };
    const auto fromLast = found(last), fromOwn = found(own);
    return fromOwn.value < fromLast.value ? moved(own, fromOwn.at, pivot) : moved(last, fromLast.at, pivot);
  }

  std::vector<Vec3d> points, few;
  OrientedGrid principal;
  Vec3d pivot;
};

}  // namespace

SphereSet gridSpheres(const CoverProblem& problem) {
  assert(!problem.points.empty());
  const Search search(problem);
  OrientedGrid grid = principalGrid(search.points);
  SphereSet best = ballsOf(grid, search.points, problem.solid);
  assert(best.size() == 1);
  int misses = 0;
  const double least = kMinPart * grid.edge;
  for (double edge = grid.edge * kShrink; misses < kMaxMisses && edge > least; edge *= kShrink) {
    grid = search.best(grid, edge);
    SphereSet set = ballsOf(grid, search.points, problem.solid);
    if (set.size() > problem.count)
      ++misses;
    else if (worstStandOff(set) < worstStandOff(best))
      best = std::move(set);
  }
  return best;
}

}  // namespace cairn::builder
