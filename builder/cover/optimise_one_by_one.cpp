// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimise_one_by_one.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "balls/ball_fit.h"
#include "balls/enclosing_ball.h"
#include "cover/downhill_simplex.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

/// Weight of the worst stand-off against the root mean square: the worst counts first, the mean decides ties (Eq. 6.1).
constexpr double kWorstWeight = 10;
constexpr std::size_t kSearchPoints = 300;
constexpr std::size_t kEvaluations = 100;
/// First steps of the search, as fractions of the radius.
constexpr double kFirstStep = 0.1;
/// The search ends after a pass that saves less than this fraction of the metric.
constexpr double kWorthAPass = 0.01;
constexpr int kMaxPasses = 10;

using Indices = std::vector<std::uint32_t>;

/// With a margin for rounding, so that a ball fitted to points holds them.
bool holds(const Ball& ball, const Vec3d& point) {
  return distance(ball.center, point) <= ball.radius * (1 + 1e-12);
}

/// A ball and the points that it must hold (Alg. 10: Points[s]).
struct Member {
  Ball ball;
  Indices points;

  /// Eq. 5.1; a ball without points is no longer in the set.
  double error() const { return points.empty() ? 0 : std::max(0.0, ball.standOff()); }
};

using Members = std::vector<Member>;

double metricOf(const Members& members) {
  double worst = 0, squares = 0;
  for (const Member& m : members) {
    worst = std::max(worst, m.error());
    squares += m.error() * m.error();
  }
  return kWorstWeight * worst + std::sqrt(squares / static_cast<double>(members.size()));
}

class OneByOne {
 public:
  OneByOne(const PointSet& points, const DepthField& solid, const SphereSet& start) : points_(points), solid_(solid) {
    std::vector<Indices> owned(start.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      std::size_t cheapest = 0;
      for (std::size_t i = 1; i < start.size(); ++i)
        if (costOf(start[i], points[p]) < costOf(start[cheapest], points[p])) cheapest = i;
      owned[cheapest].push_back(p);
    }
    for (std::size_t i = 0; i < start.size(); ++i) members_.push_back({start[i], {}});
    for (std::size_t i = 0; i < start.size(); ++i) members_[i] = fitted(members_[i], std::move(owned[i]));
  }

  /// Alg. 9.
  void run() {
    double metric = metricOf(members_);
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      std::vector<bool> done(members_.size(), false);
      for (std::size_t n = 0; n < members_.size(); ++n) {
        std::size_t worst = members_.size();
        for (std::size_t i = 0; i < members_.size(); ++i)
          if (!done[i] && (worst == members_.size() || members_[i].error() > members_[worst].error())) worst = i;
        done[worst] = true;
        manipulate(worst);
      }
      const double before = std::exchange(metric, metricOf(members_));
      if (metric > before * (1 - kWorthAPass)) return;
    }
  }

  const Members& members() const { return members_; }

 private:
  /// The tighter of the smallest enclosing ball and the old centre's (errata to `FitSphere`).
  Member fitted(const Member& old, Indices indices) const {
    if (indices == old.points) return old;
    if (indices.empty()) return {old.ball, {}};
    std::vector<Vec3d> list;
    for (const std::uint32_t p : indices) list.push_back(points_[p]);
    const PointSet held(list);
    const EnclosingBall smallest = smallestEnclosingBall(list);
    const Ball enclosing{smallest.center, smallest.radius, solid_.depth(smallest.center)};
    const Ball around{old.ball.center, held.farthest(old.ball.center).distance, old.ball.depth};
    return {enclosing.standOff() < around.standOff() ? enclosing : around, std::move(indices)};
  }

  Indices inside(const Ball& ball) const {
    Indices indices;
    for (std::uint32_t p = 0; p < points_.size(); ++p)
      if (holds(ball, points_[p])) indices.push_back(p);
    return indices;
  }

  std::size_t nearestBut(std::size_t moved, const Vec3d& point) const {
    std::size_t nearest = moved;
    double least = kInfinity;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const double gap = distance(members_[i].ball.center, point) - members_[i].ball.radius;
      if (i == moved || members_[i].points.empty() || gap >= least) continue;
      least = gap;
      nearest = i;
    }
    return nearest;
  }

  /// Returns the set with `ball` in place of member `moved` (Alg. 10). Empty when no ball can take some point.
  Members with(std::size_t moved, const Ball& ball) const {
    std::vector<Indices> shares(members_.size());
    for (std::size_t i = 0; i < members_.size(); ++i)
      for (const std::uint32_t p : members_[i].points)
        if (i != moved && !holds(ball, points_[p])) shares[i].push_back(p);
    for (const std::uint32_t p : members_[moved].points) {
      if (holds(ball, points_[p])) continue;
      const std::size_t nearest = nearestBut(moved, points_[p]);
      if (nearest == moved) return {};
      Indices& share = shares[nearest];
      const auto place = std::lower_bound(share.begin(), share.end(), p);
      if (place == share.end() || *place != p) share.insert(place, p);
    }
    Members changed;
    for (std::size_t i = 0; i < members_.size(); ++i)
      changed.push_back(i == moved ? Member{ball, inside(ball)} : fitted(members_[i], std::move(shares[i])));
    return changed;
  }

  void manipulate(std::size_t moved) {
    for (Member& m : members_) m.points = inside(m.ball);
    const Ball old = members_[moved].ball;
    const auto ballAt = [&](const std::array<double, 4>& x) {
      const Vec3d center = old.center + Vec3d(x[0], x[1], x[2]);
      return Ball{center, old.radius + x[3], solid_.depth(center)};
    };
    const double step = kFirstStep * old.radius;
    const auto optimum =
        downhillSimplex<4>({}, {step, step, step, -step}, kEvaluations, [&](const std::array<double, 4>& x) {
          const Ball ball = ballAt(x);
          const Members changed = ball.radius > 0 ? with(moved, ball) : Members{};
          return changed.empty() ? kInfinity : metricOf(changed);
        });
    Members changed = with(moved, ballAt(optimum.at));
    if (!changed.empty() && metricOf(changed) < metricOf(members_)) members_ = std::move(changed);
  }

  const PointSet& points_;
  const DepthField& solid_;
  Members members_;
};

/// Gives every point to the ball with the least cost and sets the radii; balls without points are dropped.
SphereSet settled(const Members& members, const PointSet& points) {
  std::vector<double> load(members.size(), -kInfinity);
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::size_t cheapest = 0;
    for (std::size_t i = 1; i < members.size(); ++i)
      if (costOf(members[i].ball, points[p]) < costOf(members[cheapest].ball, points[p])) cheapest = i;
    load[cheapest] = std::max(load[cheapest], distance(members[cheapest].ball.center, points[p]));
  }
  SphereSet set;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (load[i] >= 0) set.push_back({members[i].ball.center, load[i], members[i].ball.depth});
  return set;
}

}  // namespace

SphereSet optimiseOneByOne(const CoverProblem& problem, SphereSet start) {
  std::vector<Vec3d> list(problem.points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = problem.points[i];
  const PointSet few(farthestPointSample(list, kSearchPoints, 0));
  OneByOne search(few, problem.solid, start);
  search.run();
  SphereSet set = settled(search.members(), problem.points);
  return coverStandOff(problem.points, set) < coverStandOff(problem.points, start) ? set : start;
}

}  // namespace cairn::builder
