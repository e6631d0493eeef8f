// SPDX-License-Identifier: GPL-3.0-or-later
#include "upper_covers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "balls/ball_fit.h"
#include "cover/optimise.h"
#include "levels/level_field.h"
#include "levels/two_levels.h"
#include "surface/random_stream.h"

namespace cairn::builder {

namespace {

/// Points, starts and rounds of swaps of the first search, and the number of its covers that continue.
constexpr std::size_t kPoints = 1500, kCoverStarts = 6, kCovers = 3;
constexpr int kSwapRounds = 6;
/// Number of times the covers are fitted to the costliest dense points.
constexpr int kSeamRounds = 3;

SphereSet randomBalls(const PointSet& points, const DepthField& field, std::size_t count, RandomStream random) {
  SphereSet balls;
  while (balls.size() < count) {
    const Vec3d center = points[static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()))];
    balls.push_back({center, 0, field.depth(center)});
  }
  return balls;
}

class UpperSearch {
 public:
  explicit UpperSearch(const TwoLevelProblem& problem)
      : problem_(problem),
        plain_(problem.solid),
        few_(evenSample(problem.points, kPoints, problem.seed % problem.points.size())) {
    result_.points = problem.points;
  }

  UpperCovers run() && {
    std::vector<SphereSet> covers(kCoverStarts);
    tbb::parallel_for(std::size_t{0}, kCoverStarts, [&](std::size_t i) {
      const SphereSet start = i == 0 ? SphereSet{fitBall(few_[0], few_, plain_)}
                                     : randomBalls(few_, plain_, problem_.branching, {problem_.seed, i});
      covers[i] = optimiseBySwaps({few_, plain_, problem_.branching}, start, kSwapRounds);
    });
    double standOff = std::numeric_limits<double>::infinity();
    for (const SphereSet& cover : covers) standOff = std::min(standOff, coverStandOff(few_, cover));
    result_.field = fieldNear(problem_.solid, std::max(standOff, problem_.negligible));
    tbb::parallel_for(std::size_t{0}, kCoverStarts, [&](std::size_t i) {
      for (Ball& ball : covers[i]) ball.depth = result_.field->depth(ball.center);
      covers[i] = optimiseBySwaps({few_, *result_.field, problem_.branching}, std::move(covers[i]), kSwapRounds);
    });
    std::stable_sort(covers.begin(), covers.end(), [&](const SphereSet& x, const SphereSet& y) {
      return coverStandOff(few_, x) < coverStandOff(few_, y);
    });
    for (std::size_t i = 0; i < kCovers; ++i) complete(covers[i]);
    std::stable_sort(result_.covers.begin(), result_.covers.end(),
                     [](const CoverLevel& x, const CoverLevel& y) { return x.limit < y.limit; });
    return std::move(result_);
  }

 private:
  /// Fits the cover to all points, then also to the costliest dense ones.
  void complete(const SphereSet& balls) {
    CoverLevel cover{levelOf(balls, 0), 0};
    const Reach dense = reachOfAll(problem_.dense.size());
    for (int round = 0; round <= kSeamRounds; ++round) {
      const Reach all = reachOfAll(result_.points.size());
      LevelProblem level{result_.points, *result_.field, all, problem_.branching, problem_.negligible};
      level.keepGoing = problem_.keepGoing;
      cover.balls = optimiseLevel(level, std::move(cover.balls));
      cover.limit = coverStandOff(level, cover.balls);
      if (round == kSeamRounds) break;
      for (const Vec3d& p : nearlyWorst(cover, problem_.dense, dense)) result_.points.push(p);
    }
    cover.limit = std::max(standOffOf(cover, problem_.dense, dense), problem_.negligible);
    result_.covers.push_back(std::move(cover));
  }

  const TwoLevelProblem& problem_;
  SolidDepth plain_;
  PointSet few_;
  UpperCovers result_;
};

}  // namespace

UpperCovers upperCovers(const TwoLevelProblem& problem) {
  return UpperSearch(problem).run();
}

}  // namespace cairn::builder
