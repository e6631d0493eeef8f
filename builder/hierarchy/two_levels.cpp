// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "hierarchy/complete_level.h"
#include "hierarchy/group_parts.h"
#include "hierarchy/level_field.h"
#include "hierarchy/share_parts.h"
#include "hierarchy/upper_covers.h"

namespace cairn::builder {

namespace {

/// Of two pairs of levels the better has the smaller product of limits, the upper's to this power: a traversal stopped
/// early sees the upper one, so what that gives up has to buy twice as much below. Upper levels within `kAsGood` of
/// the best are all as good: which one is found is chance, and the level below should decide.
constexpr double kUpperWeight = 2, kAsGood = 1.03;
/// Sizes of the flat covers families are formed from, in parts of a full lower level: the fewer balls, the easier to
/// group; families are filled up afterwards.
constexpr std::array kFlatShares{0.625, 0.75, 0.8125, 0.875};
/// The upper level's limit on its way down: this factor a step, to this part of what it needs for itself at least.
constexpr double kTightening = 0.975, kTightest = 1.02;
/// Pairs that are completed between the points, and attempts of each relief of their lower levels.
constexpr std::size_t kCompleted = 2, kReliefAttempts = 25;

struct TwoLevels {
  CoverLevel upper, lower;
};

class Search {
 public:
  explicit Search(const TwoLevelProblem& problem)
      : problem_(problem),
        uppers_(upperCovers(problem)),
        points_(uppers_.points),
        all_(reachOfAll(points_.size())),
        plain_(problem.solid) {}

  TwoLevels run() {
    const std::size_t full = problem_.branching * problem_.branching;
    const double standOff = standOffIn(all_, fitFlat(plain_, full, {}));
    lowerField_ = fieldNear(problem_.solid, std::max(standOff, problem_.negligible));
    const std::size_t covers = uppers_.covers.size();
    std::vector<TwoLevels> found(covers + kFlatShares.size());
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      found[i] = i < covers ? lowerBelow(uppers_.covers[i], {}) : fromFlat(kFlatShares[i - covers]);
    });
    const auto better = [&](const TwoLevels& x, const TwoLevels& y) { return scoreOf(x) < scoreOf(y); };
    std::stable_sort(found.begin(), found.end(), better);
    const std::size_t count = std::min(kCompleted, found.size());
    for (std::size_t i = 0; i < count; ++i) found[i] = completed(std::move(found[i]));
    return *std::min_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), better);
  }

 private:
  LevelProblem level(const DepthField& field, const Reach& reach, std::size_t branching, double enough = 0) const {
    LevelProblem level{points_, field, reach, branching, std::max(enough, problem_.negligible)};
    level.keepGoing = problem_.keepGoing;
    return level;
  }
  double standOffIn(const Reach& reach, std::span<const ChildBall> balls) const {
    return coverStandOff(level(plain_, reach, 1), balls);
  }
  double tightest() const { return uppers_.covers[0].limit; }
  double scoreOf(const TwoLevels& levels) const {
    return std::pow(std::max(levels.upper.limit, kAsGood * tightest()), kUpperWeight) * levels.lower.limit;
  }

  std::vector<ChildBall> fitFlat(const DepthField& field, std::size_t count, std::vector<ChildBall> start) const {
    for (ChildBall& child : start) child.ball.depth = field.depth(child.ball.center);
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

  /// From a cover of the whole surface by that part of a full lower level.
  TwoLevels fromFlat(double share) const {
    const auto full = static_cast<double>(problem_.branching * problem_.branching);
    const auto count = static_cast<std::size_t>(std::lround(share * full));
    const std::vector<ChildBall> flat = fitFlat(*lowerField_, count, fitFlat(plain_, count, {}));
    return tightened(families(flat));
  }

  /// Families of the flat cover's balls below an upper level that is as tight as the search finds. A ball that two
  /// parents hold together becomes two.
  TwoLevels families(const std::vector<ChildBall>& flat) const {
    const std::vector<PointSet> parts = partsOf(flat);
    SphereSet start = ballsOf(uppers_.covers[0].balls);
    for (std::size_t i = 0; start.size() < problem_.branching; ++i) start.push_back(start[i]);
    start = groupParts(parts, *uppers_.field, std::move(start), problem_.branching, problem_.seed);
    SharedParts shared =
        shareParts(parts, *uppers_.field, std::move(start), tightest(), problem_.branching, problem_.seed);
    CoverLevel upper{levelOf(shared.parents, 0), shared.limit};
    upper.limit = std::max(upper.limit, standOffIn(all_, upper.balls));
    std::vector<ChildBall> children;
    for (std::size_t i = 0; i < flat.size(); ++i)
      for (const std::uint32_t parent : shared.parentsOf[i]) children.push_back({flat[i].ball, parent});
    return lowerBelow(std::move(upper), std::move(children));
  }

  /// By ball of a flat cover: the points it holds most cheaply.
  std::vector<PointSet> partsOf(const std::vector<ChildBall>& flat) const {
    std::vector<PointSet> parts(flat.size());
    const Reach owned = ownedBy({flat, 0}, points_, all_);
    for (std::size_t i = 0; i < owned.size(); ++i)
      for (const std::uint32_t p : owned[i]) parts[i].push(points_[p]);
    return parts;
  }

  /// Lowers the upper level's limit step by step towards what it needs for itself, as far as its balls follow, and
  /// returns the best pair on the way. Balls move only as far as each step asks, so the families survive.
  TwoLevels tightened(TwoLevels levels) const {
    TwoLevels best = levels;
    const double lowest = kTightest * tightest();
    while (levels.upper.limit > lowest) {
      CoverLevel next{levels.upper.balls, std::max(kTightening * levels.upper.limit, lowest)};
      const LevelProblem problem = level(*uppers_.field, all_, problem_.branching, next.limit);
      next.balls = optimiseLevel(problem, std::move(next.balls));
      const bool kept = next.balls.size() == levels.upper.balls.size();
      if (!kept || coverStandOff(problem, next.balls) > next.limit) break;
      levels = lowerBelow(std::move(next), std::move(levels.lower.balls));
      if (scoreOf(levels) < scoreOf(best)) best = levels;
    }
    return best;
  }

  /// Takes in what lies between the points, and lowers the lower level where it is worst. The upper level stays, or
  /// families would fall apart; its limit is raised to what the dense points need.
  TwoLevels completed(TwoLevels levels) {
    const Reach dense = reachOfAll(problem_.dense.size());
    levels.upper.limit = std::max(standOffOf(levels.upper, problem_.dense, dense), levels.upper.limit);
    const Reach reach = reachOf(levels.upper, problem_.dense, dense);
    for (const Vec3d& p : nearlyWorst(levels.lower, problem_.dense, reach)) points_.push(p);
    const LevelSurface surface{points_,           problem_.dense,     std::span(&levels.upper, 1),
                               *lowerField_,      problem_.branching, problem_.negligible,
                               problem_.keepGoing};
    levels.lower = completeLevel(surface, std::move(levels.lower), kReliefAttempts);
    return levels;
  }

  const TwoLevelProblem& problem_;
  UpperCovers uppers_;
  PointSet points_;
  Reach all_;
  SolidDepth plain_;
  std::unique_ptr<DepthField> lowerField_;
};

}  // namespace

std::vector<CoverLevel> coverTwoLevels(const TwoLevelProblem& problem) {
  TwoLevels levels = Search(problem).run();
  return {std::move(levels.upper), std::move(levels.lower)};
}

CoverLevel coverOneLevel(const TwoLevelProblem& problem) {
  return upperCovers(problem).covers[0];
}

}  // namespace cairn::builder
