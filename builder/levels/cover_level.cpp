// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover_level.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace cairn::builder {

namespace {

/// The fraction of the limit that counts as nearly the limit, and the approximate number of such points for each ball.
constexpr double kNearlyWorst = 0.97;
constexpr std::size_t kWorstPerBall = 10, kMaxWorst = 1000;

/// By point: the least cost over the balls that may hold it.
std::vector<double> leastCosts(const CoverLevel& level, const PointSet& points, const Reach& parents) {
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  for (const ChildBall& child : level.balls)
    for (const std::uint32_t p : parents[child.parent]) least[p] = std::min(least[p], costOf(child.ball, points[p]));
  return least;
}

}  // namespace

std::vector<ChildBall> levelOf(const SphereSet& balls, std::uint32_t parent) {
  std::vector<ChildBall> level;
  for (const Ball& ball : balls) level.push_back({ball, parent});
  return level;
}

SphereSet ballsOf(const std::vector<ChildBall>& level) {
  SphereSet balls;
  for (const ChildBall& child : level) balls.push_back(child.ball);
  return balls;
}

Reach reachOfAll(std::size_t points) {
  Reach all(1, std::vector<std::uint32_t>(points));
  std::iota(all[0].begin(), all[0].end(), 0U);
  return all;
}

Reach reachOf(const CoverLevel& level, const PointSet& points, const Reach& parents) {
  Reach reach(level.balls.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    for (const std::uint32_t p : parents[level.balls[i].parent])
      if (costOf(level.balls[i].ball, points[p]) <= level.limit) reach[i].push_back(p);
  return reach;
}

Reach reachThrough(std::span<const CoverLevel> levels, const PointSet& points) {
  Reach reach = reachOfAll(points.size());
  for (const CoverLevel& level : levels) reach = reachOf(level, points, reach);
  return reach;
}

Reach ownedBy(const CoverLevel& level, const PointSet& points, const Reach& parents) {
  constexpr std::uint32_t kNoOwner = ~0U;
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> owner(points.size(), kNoOwner);
  for (std::uint32_t i = 0; i < level.balls.size(); ++i)
    for (const std::uint32_t p : parents[level.balls[i].parent])
      if (const double cost = costOf(level.balls[i].ball, points[p]); cost < least[p]) {
        least[p] = cost;
        owner[p] = i;
      }
  Reach owned(level.balls.size());
  for (std::uint32_t p = 0; p < owner.size(); ++p)
    if (owner[p] != kNoOwner) owned[owner[p]].push_back(p);
  return owned;
}

double standOffOf(const CoverLevel& level, const PointSet& points, const Reach& parents) {
  const std::vector<double> least = leastCosts(level, points, parents);
  return *std::max_element(least.begin(), least.end());
}

void widenLimits(std::span<CoverLevel> levels, const PointSet& points) {
  Reach reach = reachOfAll(points.size());
  for (CoverLevel& level : levels) {
    level.limit = std::max(level.limit, standOffOf(level, points, reach));
    reach = reachOf(level, points, reach);
  }
}

std::vector<Vec3d> nearlyWorst(const CoverLevel& level, const PointSet& points, const Reach& parents) {
  const std::vector<double> least = leastCosts(level, points, parents);
  std::vector<Vec3d> worst;
  for (std::size_t p = 0; p < least.size(); ++p)
    if (least[p] > kNearlyWorst * level.limit) worst.push_back(points[p]);
  return farthestPointSample(worst, std::min(kMaxWorst, kWorstPerBall * level.balls.size()), 0);
}

}  // namespace cairn::builder
