// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/minimax_cover.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "cover/level_cover.h"
#include "flat/relocate.h"
#include "levels/cover_level.h"
#include "levels/level_field.h"

namespace cairn::builder {
namespace {

/// Points for each ball that starts are compared on, and at least.
constexpr std::size_t kFewPerBall = 40, kMinFew = 1500;
/// Starts gone on with in the closing, and of these with all points.
constexpr std::size_t kSecondRound = 4, kThirdRound = 2;
/// Attempts of a relocation: so many, and for each ball, up to a most.
constexpr std::size_t kAttempts = 60, kAttemptsPerBall = 6, kMaxAttempts = 600;
/// A quick search: parts of them.
constexpr std::size_t kQuickPart = 4;
/// Rounds in which the points between the points join.
constexpr int kRounds = 6;
/// Within this factor of what the points need, the dense points have nothing to add.
constexpr double kComplete = 1.005;
/// A closing is made anew when the stand-off has fallen below this part of the one it was made for: its scale is 0.85
/// of that, below which it says nothing.
constexpr double kTooCoarse = 0.93;

struct Candidate {
  SphereSet balls;
  double standOff = std::numeric_limits<double>::infinity();
};

class MinimaxSearch {
 public:
  MinimaxSearch(const FlatProblem& problem, const FlatPoints& points, DepthOf depthOf)
      : problem_(problem),
        points_(points),
        depthOf_(depthOf),
        few_(evenSample(points.points, std::max(kMinFew, kFewPerBall * problem.count), 0)),
        field_(std::make_unique<SolidDepth>(problem.solid)) {}

  FlatSet run(std::vector<SphereSet> starts) {
    std::vector<Candidate> candidates;
    for (SphereSet& start : starts) candidates.push_back({std::move(start)});
    if (candidates.empty()) return {};  // cancelled before there was a start
    each(candidates, few_, 0);
    keepBest(candidates, kSecondRound);
    remakeField(candidates.front().standOff);
    each(candidates, few_, attempts());
    keepBest(candidates, kThirdRound);
    remakeField(candidates.front().standOff);
    std::vector<FlatSet> sets(candidates.size());
    tbb::parallel_for(std::size_t{0}, sets.size(), [&](std::size_t i) { sets[i] = completed(candidates[i]); });
    if (!problem_.keepGoing()) return {};
    return *std::min_element(sets.begin(), sets.end(),
                             [](const FlatSet& a, const FlatSet& b) { return a.standOff < b.standOff; });
  }

 private:
  std::size_t attempts() const {
    return std::min(kAttempts + kAttemptsPerBall * problem_.count, kMaxAttempts) / (problem_.quick ? kQuickPart : 1);
  }

  /// The field at the stand-off reached; depths of balls are to be measured anew.
  void remakeField(double standOff) {
    if (depthOf_ == DepthOf::solid || !problem_.keepGoing()) return;
    const double scale = depthOf_ == DepthOf::closing ? 1 : 0.5;
    field_ = fieldNear(problem_.solid, scale * std::max(standOff, problem_.negligible));
  }

  void measureDepths(SphereSet& balls) const {
    for (Ball& ball : balls) ball.depth = field_->depth(ball.center);
  }

  /// Optimised for these points, then relocated.
  SphereSet improved(SphereSet balls, const PointSet& points, std::size_t attempts) const {
    measureDepths(balls);
    const Reach all = reachOfAll(points.size());
    LevelProblem level{points, *field_, all, problem_.count, problem_.negligible};
    level.keepGoing = &problem_.keepGoing;
    SphereSet best = ballsOf(optimiseLevel(level, levelOf(balls, 0)));
    if (attempts == 0) return best;
    return relocate({points, *field_, problem_.count, problem_.negligible, attempts, problem_.keepGoing},
                    std::move(best));
  }

  void each(std::vector<Candidate>& candidates, const PointSet& points, std::size_t attempts) const {
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
      if (!problem_.keepGoing()) return;
      candidates[i].balls = improved(std::move(candidates[i].balls), points, attempts);
      candidates[i].standOff = coverStandOff(points, candidates[i].balls);
    });
  }

  static void keepBest(std::vector<Candidate>& candidates, std::size_t count) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.standOff < b.standOff; });
    candidates.resize(std::min(count, candidates.size()));
  }

  /// Fitted to all points, then to the dense ones that cost most as well.
  FlatSet completed(const Candidate& candidate) const {
    PointSet points = points_.points;
    FlatSet best{{}, std::numeric_limits<double>::infinity()};
    const Reach dense = reachOfAll(points_.dense.size());
    SphereSet balls = candidate.balls;
    for (int round = 0; round < kRounds && problem_.keepGoing(); ++round) {
      balls = improved(std::move(balls), points, round == 0 ? attempts() : attempts() / kQuickPart);
      const double needed = coverStandOff(points, balls);
      const CoverLevel level{levelOf(balls, 0), needed};
      const double standOff = standOffOf(level, points_.dense, dense);
      if (standOff < best.standOff) best = {balls, standOff};
      if (standOff <= kComplete * needed) break;
      for (const Vec3d& p : nearlyWorst(level, points_.dense, dense)) points.push(p);
    }
    return best;
  }

  const FlatProblem& problem_;
  const FlatPoints& points_;
  DepthOf depthOf_;
  PointSet few_;
  std::unique_ptr<DepthField> field_;
};

}  // namespace

FlatSet minimaxCover(const FlatProblem& problem, const FlatPoints& points, DepthOf depthOf,
                     std::vector<SphereSet> starts) {
  return MinimaxSearch(problem, points, depthOf).run(std::move(starts));
}

}  // namespace cairn::builder
