// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "levels/complete_level.h"
#include "levels/draw_families.h"
#include "levels/fit_families.h"
#include "levels/level_field.h"
#include "levels/upper_covers.h"

namespace cairn::builder {

namespace {

/// The better of two pairs of levels has the smaller product of limits, with the upper limit to this power. A traversal
/// that stops early sees the upper level. So a loss there must gain three times as much below. Upper levels within
/// `kAsGood` of the best count as equal: chance decides which one is found, and the level below should decide instead.
constexpr double kUpperWeight = 3, kAsGood = 1.03;
/// Exponent for the estimated limit of the third level. It varies between pairs twice as much as the second limit does,
/// but it is only an estimate.
constexpr double kNextWeight = 0.5;
/// Number of families drawn; the most promising are filled up, and the best pairs continue.
constexpr std::size_t kDraws = 12, kFilledUp = 6, kTightened = 4;
/// The upper level's limit falls by this factor a step, down to this fraction of its own need.
constexpr double kUpperTightening = 0.975, kTightest = 1.02;
/// Number of pairs that are completed between the points, and attempts to relieve their lower levels.
constexpr std::size_t kCompleted = 3;
constexpr ReliefEffort kRelief{.attempts = 25, .redraws = 0};
/// The estimate of the third level uses this fraction of the dense points, and at most this many points of a family
/// that is fitted alone.
constexpr std::size_t kAheadPart = 3, kFamilyPoints = 150;

struct TwoLevels {
  CoverLevel upper, lower;
  double next = 1;  // estimated need of the level below; equal for all while unknown
};

class Search {
 public:
  explicit Search(const TwoLevelProblem& problem)
      : problem_(problem),
        uppers_(upperCovers(problem)),
        points_(uppers_.points),
        ahead_(problem.deeper ? evenSample(problem.dense, problem.dense.size() / kAheadPart, 0) : PointSet()),
        all_(reachOfAll(points_.size())),
        plain_(problem.solid) {}

  TwoLevels run() {
    const std::size_t full = problem_.branching * problem_.branching;
    const double standOff = standOffIn(all_, optimiseLevel(level(plain_, all_, full), {}));
    lowerField_ = fieldNear(problem_.solid, std::max(standOff, problem_.negligible));
    std::vector<TwoLevels> found = pairs();
    keepBest(found, kTightened);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) { found[i] = tightened(std::move(found[i])); });
    keepBest(found, kCompleted);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      found[i] = completed(std::move(found[i]));
      if (problem_.deeper) found[i].next = nextStandOff(found[i]);
    });
    keepBest(found, 1);
    return std::move(found[0]);
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
  double scoreOf(const CoverLevel& upper, double lower) const {
    return std::pow(std::max(upper.limit, kAsGood * tightest()), kUpperWeight) * lower;
  }
  double scoreOf(const TwoLevels& levels) const {
    return scoreOf(levels.upper, levels.lower.limit) * std::pow(levels.next, kNextWeight);
  }
  void keepBest(std::vector<TwoLevels>& found, std::size_t count) const {
    std::stable_sort(found.begin(), found.end(),
                     [&](const TwoLevels& x, const TwoLevels& y) { return scoreOf(x) < scoreOf(y); });
    found.resize(std::min(count, found.size()));
  }

  /// Lower levels below each of the upper covers, and below the most promising of the drawn families.
  std::vector<TwoLevels> pairs() const {
    std::vector<DrawnFamilies> drawn = drawFamilies(problem_, uppers_, *lowerField_, kDraws);
    std::stable_sort(drawn.begin(), drawn.end(), [&](const DrawnFamilies& x, const DrawnFamilies& y) {
      return scoreOf(x.upper, x.promise) < scoreOf(y.upper, y.promise);
    });
    drawn.resize(kFilledUp);
    for (const CoverLevel& cover : uppers_.covers) drawn.push_back({cover, {}, 0});
    std::vector<TwoLevels> found(drawn.size());
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      found[i] = lowerBelow(std::move(drawn[i].upper), std::move(drawn[i].children));
    });
    return found;
  }

  /// Fits the lower level below an upper one, from a start whose parents are the upper one's balls.
  TwoLevels lowerBelow(CoverLevel upper, std::vector<ChildBall> start) const {
    const Reach reach = reachOf(upper, points_, all_);
    CoverLevel lower;
    lower.balls = optimiseLevel(level(*lowerField_, reach, problem_.branching), std::move(start));
    lower.limit = std::max(standOffIn(reach, lower.balls), problem_.negligible);
    return {std::move(upper), std::move(lower), 1};
  }

  /// Lowers the upper level's limit step by step towards its own need, as far as its balls follow, and returns the best
  /// pair on the way. Balls move only as far as each step requires, so the families survive.
  TwoLevels tightened(TwoLevels levels) const {
    TwoLevels best = levels;
    const double lowest = kTightest * tightest();
    while (levels.upper.limit > lowest) {
      CoverLevel next{levels.upper.balls, std::max(kUpperTightening * levels.upper.limit, lowest)};
      const LevelProblem problem = level(*uppers_.field, all_, problem_.branching, next.limit);
      next.balls = optimiseLevel(problem, std::move(next.balls));
      const bool kept = next.balls.size() == levels.upper.balls.size();
      if (!kept || coverStandOff(problem, next.balls) > next.limit) break;
      levels = lowerBelow(std::move(next), std::move(levels.lower.balls));
      if (scoreOf(levels) < scoreOf(best)) best = levels;
    }
    return best;
  }

  /// Adds the surface between the points, and lowers the lower level where it is worst. The upper level stays, or
  /// families would fall apart. Its limit is raised to the dense points' need.
  TwoLevels completed(TwoLevels levels) const {
    const Reach dense = reachOfAll(problem_.dense.size());
    levels.upper.limit = std::max(standOffOf(levels.upper, problem_.dense, dense), levels.upper.limit);
    const Reach reach = reachOf(levels.upper, problem_.dense, dense);
    PointSet points = points_;  // a copy: points join each pair separately
    for (const Vec3d& p : nearlyWorst(levels.lower, problem_.dense, reach)) points.push(p);
    const LevelSurface surface{points,
                               problem_.dense,
                               std::span(&levels.upper, 1),
                               *lowerField_,
                               problem_.branching,
                               problem_.negligible,
                               problem_.keepGoing};
    levels.lower = completeLevel(surface, std::move(levels.lower), kRelief);
    return levels;
  }

  /// Estimates the need of a third level, on few points. One family with more than its share, which its neighbours
  /// cannot relieve, would decide that level's error. Neither limit shows this.
  double nextStandOff(const TwoLevels& levels) const {
    const PointSet& points = ahead_;
    std::vector<CoverLevel> above{levels.upper, levels.lower};
    widenLimits(above, points);
    const Reach owned = ownedBy(above[1], points, reachThrough(std::span(above).first(1), points));
    const Reach reach = reachThrough(above, points);
    LevelProblem next{points, plain_, reach, problem_.branching, problem_.negligible};
    next.keepGoing = problem_.keepGoing;
    const FamilySettings alone{problem_.branching, kFamilyPoints,       0,
                               problem_.seed,      problem_.negligible, problem_.keepGoing};
    return coverStandOff(next, optimiseLevel(next, fitFamilies(owned, points, plain_, alone)));
  }

  const TwoLevelProblem& problem_;
  UpperCovers uppers_;
  PointSet points_, ahead_;
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
