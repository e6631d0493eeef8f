// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "spheres/ball_fit.h"
#include "spheres/capacity_assignment.h"
#include "spheres/enclosing_ball.h"
#include "spheres/optimise.h"

namespace cairn::builder {

namespace {

/// How much of its fit the upper level may give up for the lower one's.
constexpr double kUpperSlack = 1.06;
/// Sizes of the flat covers families are formed from, in parts of a full lower level: the fewer balls, the easier to
/// group; families are filled up afterwards.
constexpr std::array kFlatShares{0.5, 0.625, 0.75, 0.875};
/// Starts of the search for families, how far each displaces the parents (in parts of their radius), and how often
/// assigning and refitting alternate at most.
constexpr int kGroupings = 40, kGroupingRounds = 8;
constexpr double kDisplacement = 0.1;
/// The upper level's limit on its way down: this factor a step.
constexpr double kTightening = 0.975;
constexpr int kUpperSwapRounds = 6;
/// Spacing of the samples of the closings the balls are fitted in, in parts of the stand-off, and how many there may
/// be.
constexpr double kClosingSpacing = 0.15, kMostClosingSamples = 60000;
constexpr int kSeamRounds = 3;
constexpr std::size_t kUpperPoints = 1500;

SphereSet ballsOf(const std::vector<ChildBall>& level) {
  SphereSet balls;
  for (const ChildBall& child : level) balls.push_back(child.ball);
  return balls;
}

std::vector<ChildBall> childrenOf(const SphereSet& balls, std::uint32_t parent) {
  std::vector<ChildBall> level;
  for (const Ball& ball : balls) level.push_back({ball, parent});
  return level;
}

/// The signed distance, or the closing of the solid near a stand-off where there is any concavity to close. Coarser
/// samples than these let balls with centres outside protrude by twice what the field says.
std::unique_ptr<DepthField> fieldAt(const SignedDistance& solid, double standOff) {
  double area = 0;
  for (const Piece& piece : piecesOf(solid.mesh())) area += areaOf(piece);
  const double spacing = std::max(kClosingSpacing * standOff, std::sqrt(area / kMostClosingSamples));
  const EnclosingBall all = smallestEnclosingBall(solid.mesh().vertices);
  auto closed =
      std::make_unique<ClosedDepth>(solid, kClosingScale * standOff, spacing, all.center, all.radius + 2 * standOff);
  if (closed->usable()) return closed;
  return std::make_unique<SolidDepth>(solid);
}

template <class Balls>
void measureIn(const DepthField& field, Balls& balls) {
  for (ChildBall& child : balls) child.ball.depth = field.depth(child.ball.center);
}

struct TwoLevels {
  CoverLevel upper, lower;
};

class Search {
 public:
  explicit Search(const TwoLevelProblem& problem)
      : problem_(problem), points_(problem.points), all_(reachOfAll(points_.size())), plain_(problem.solid) {
    fitUpper();
  }

  const CoverLevel& upper() const { return upper_; }

  TwoLevels run() {
    std::vector<ChildBall> flat = fitFlat(plain_, problem_.branching * problem_.branching, {});
    const double standOff = std::max(standOffIn(all_, flat), problem_.negligible);
    lowerField_ = fieldAt(problem_.solid, standOff);
    std::vector<TwoLevels> found(kFlatShares.size() + 1);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      found[i] = i == 0 ? lowerBelow(upper_, {}) : fromFlat(kFlatShares[i - 1]);
    });
    const auto best = std::min_element(found.begin(), found.end(), [](const TwoLevels& x, const TwoLevels& y) {
      return x.lower.limit < y.lower.limit;
    });
    return completed(*best);
  }

 private:
  LevelProblem level(const DepthField& field, const Reach& reach, std::size_t branching, double enough = 0) const {
    return {points_, field, reach, branching, std::max(enough, problem_.negligible)};
  }
  double standOffIn(const Reach& reach, std::span<const ChildBall> balls) const {
    return coverStandOff(level(plain_, reach, 1), balls);
  }

  /// The best upper level for itself.
  void fitUpper() {
    std::vector<Vec3d> list(points_.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = points_[i];
    const PointSet few(farthestPointSample(list, kUpperPoints, problem_.seed % list.size()));
    const CoverProblem rough{few, plain_, problem_.branching};
    SphereSet balls = optimiseBySwaps(rough, {fitBall(few[0], few, plain_)}, kUpperSwapRounds);
    const double standOff = std::max(coverStandOff(few, balls), problem_.negligible);
    upperField_ = fieldAt(problem_.solid, standOff);
    for (Ball& ball : balls) ball.depth = upperField_->depth(ball.center);
    const CoverProblem closed{few, *upperField_, problem_.branching};
    balls = optimiseBySwaps(closed, std::move(balls), kUpperSwapRounds);
    upper_.balls = optimiseLevel(level(*upperField_, all_, problem_.branching), childrenOf(balls, 0));
    upper_.limit = kUpperSlack * std::max(standOffIn(all_, upper_.balls), problem_.negligible);
  }

  std::vector<ChildBall> fitFlat(const DepthField& field, std::size_t count, std::vector<ChildBall> start) const {
    measureIn(field, start);
    return optimiseLevel(level(field, all_, count), std::move(start));
  }

  /// The lower level below an upper one, from a start whose parents are the upper one's balls.
  TwoLevels lowerBelow(CoverLevel upper, std::vector<ChildBall> start) const {
    const Reach reach = reachOf(upper, points_, all_);
    CoverLevel lower;
    lower.balls = optimiseLevel(level(*lowerField_, reach, problem_.branching), std::move(start));
    lower.limit = std::max(standOffIn(reach, lower.balls), problem_.negligible);
    return {std::move(upper), std::move(lower)};
  }

  TwoLevels fromFlat(double share) const {
    const auto full = static_cast<double>(problem_.branching * problem_.branching);
    const auto count = static_cast<std::size_t>(std::lround(share * full));
    std::vector<ChildBall> flat = fitFlat(*lowerField_, count, fitFlat(plain_, count, {}));
    return tightened(grouped(std::move(flat)));
  }

  /// Lowers the upper level's limit step by step until it is what the upper level may have at most. Balls move only as
  /// far as each step asks, so the families survive.
  TwoLevels tightened(TwoLevels levels) const {
    while (levels.upper.limit > upper_.limit) {
      CoverLevel next{levels.upper.balls, std::max(kTightening * levels.upper.limit, upper_.limit)};
      const LevelProblem problem = level(*upperField_, all_, problem_.branching, next.limit);
      next.balls = optimiseLevel(problem, std::move(next.balls));
      const bool kept = next.balls.size() == levels.upper.balls.size();
      if (!kept || coverStandOff(problem, next.balls) > next.limit) return lowerBelow(upper_, {});
      levels = lowerBelow(std::move(next), std::move(levels.lower.balls));
    }
    return levels;
  }

  /// Takes in what lies between the points: both levels are fitted to the worst of the dense points as well, a few
  /// times, then their limits are set to what those need.
  TwoLevels completed(TwoLevels levels) {
    const Reach dense = reachOfAll(problem_.dense.size());
    for (int round = 0; round < kSeamRounds; ++round) {
      for (const Vec3d& p : nearlyWorst(levels.upper, problem_.dense, dense)) points_.push(p);
      const Reach denseReach = reachOf(levels.upper, problem_.dense, dense);
      for (const Vec3d& p : nearlyWorst(levels.lower, problem_.dense, denseReach)) points_.push(p);
      all_ = reachOfAll(points_.size());
      CoverLevel upper = levels.upper;
      upper.balls = optimiseLevel(level(*upperField_, all_, problem_.branching, upper.limit), std::move(upper.balls));
      if (upper.balls.size() != levels.upper.balls.size()) break;
      upper.limit = std::max(upper.limit, standOffIn(all_, upper.balls));
      levels = lowerBelow(std::move(upper), std::move(levels.lower.balls));
    }
    levels.upper.limit = std::max(standOffOf(levels.upper, problem_.dense, dense), levels.upper.limit);
    const Reach denseReach = reachOf(levels.upper, problem_.dense, dense);
    levels.lower.limit = std::max(standOffOf(levels.lower, problem_.dense, denseReach), problem_.negligible);
    return levels;
  }

  /// Families of the flat cover's balls below an upper level that is as tight as the search finds.
  TwoLevels grouped(std::vector<ChildBall> flat) const {
    const std::vector<PointSet> parts = partsOf(flat);
    std::mt19937_64 random(problem_.seed);
    CoverLevel best{upper_.balls, std::numeric_limits<double>::infinity()};
    std::vector<std::uint32_t> familyOf(flat.size(), 0);
    for (int i = 0; i < kGroupings; ++i) {
      SphereSet parents = ballsOf(best.balls);
      if (i > 0) displace(parents, random);
      double last = std::numeric_limits<double>::infinity();
      for (int round = 0; round < kGroupingRounds; ++round) {
        const std::vector<std::uint32_t> families = assignWithin(costsOf(parts, parents), problem_.branching);
        const double reached = refit(parents, parts, families);
        if (reached < best.limit) {
          best = {childrenOf(parents, 0), reached};
          familyOf = families;
        }
        if (reached >= 0.999 * last) break;
        last = reached;
      }
    }
    best.limit = std::max(best.limit, upper_.limit);
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i].parent = familyOf[i];
    return lowerBelow(std::move(best), std::move(flat));
  }

  /// By ball of a flat cover: the points it holds most cheaply.
  std::vector<PointSet> partsOf(const std::vector<ChildBall>& flat) const {
    std::vector<PointSet> parts(flat.size());
    const Reach owned = ownedBy({flat, 0}, points_, all_);
    for (std::size_t i = 0; i < owned.size(); ++i)
      for (const std::uint32_t p : owned[i]) parts[i].push(points_[p]);
    return parts;
  }

  static CostTable costsOf(const std::vector<PointSet>& parts, const SphereSet& parents) {
    CostTable table{parents.size(), {}};
    for (const PointSet& part : parts)
      for (const Ball& parent : parents)
        table.costs.push_back(part.empty() ? 0 : part.farthest(parent.center).distance - parent.depth);
    return table;
  }

  /// Fits each parent to its family; returns the worst stand-off.
  double refit(SphereSet& parents, const std::vector<PointSet>& parts,
               const std::vector<std::uint32_t>& families) const {
    double worst = 0;
    for (std::uint32_t k = 0; k < parents.size(); ++k) {
      PointSet held;
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (families[i] == k)
          for (std::size_t p = 0; p < parts[i].size(); ++p) held.push(parts[i][p]);
      if (held.empty()) continue;
      parents[k] = fitBall(parents[k].center, held, *upperField_);
      worst = std::max(worst, parents[k].standOff());
    }
    return worst;
  }

  void displace(SphereSet& parents, std::mt19937_64& random) const {
    const auto uniform = [&] { return 2 * (static_cast<double>(random() >> 11) / 9007199254740992.0) - 1; };
    for (Ball& ball : parents) {
      const double step = kDisplacement * ball.radius;
      const double x = uniform(), y = uniform(), z = uniform();
      ball.center += Vec3d(x, y, z) * step;
      ball.depth = upperField_->depth(ball.center);
    }
  }

  const TwoLevelProblem& problem_;
  PointSet points_;
  Reach all_;
  SolidDepth plain_;
  std::unique_ptr<DepthField> upperField_, lowerField_;
  CoverLevel upper_;  // the best for itself, its limit the slack included
};

}  // namespace

std::vector<CoverLevel> coverTwoLevels(const TwoLevelProblem& problem) {
  TwoLevels levels = Search(problem).run();
  return {std::move(levels.upper), std::move(levels.lower)};
}

CoverLevel coverOneLevel(const TwoLevelProblem& problem) {
  CoverLevel level = Search(problem).upper();
  level.limit /= kUpperSlack;
  return level;
}

}  // namespace cairn::builder
