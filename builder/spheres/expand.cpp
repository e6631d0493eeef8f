// SPDX-License-Identifier: GPL-3.0-or-later
#include "expand.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "spheres/farthest_sample.h"
#include "spheres/held_sets.h"

namespace cairn::builder {

namespace {

/// Halvings of the interval of the stand-off: it then is known to 0.1 % of what one ball alone needs.
constexpr int kBisections = 10;
/// Attempts with the leading candidate barred, for shapes where the largest ball is in the way of a better set (5.3.3).
constexpr int kMaxBarred = 2;

/// Growth of the stand-off while a set of more than one ball is looked for, and how often at most.
constexpr double kNextStandOff = 1.05;
constexpr int kMaxSteps = 20;

/// By max-elim the selection is a starting point for `optimise`, which sees all points and moves centres freely: these
/// many candidates and points are enough for that, and the cost is quadratic in the first.
constexpr std::size_t kMaxCandidates = 150, kMaxPoints = 300;

using Choice = std::vector<std::size_t>;

/// What a greedy choice among candidates came to.
struct Outcome {
  std::optional<Choice> chosen;  ///< nothing when the balls do not suffice
  std::size_t first = 0;         ///< the candidate it began with
  bool hopeless = false;         ///< no choice of as many candidates can suffice
};

/// What the candidates hold at one stand-off, and the greedy choice among them.
class Selection {
 public:
  Selection(HeldSets held, std::size_t points, ExpandRank rank)
      : held_(std::move(held)), points_(points), rank_(rank) {}

  /// The candidates that alone hold everything.
  Choice complete() const {
    Choice list;
    for (std::size_t i = 0; i < held_.size(); ++i)
      if (held_.count(i) == points_) list.push_back(i);
    return list;
  }

  /// At most `count` candidates, without those `barred`.
  Outcome choose(std::size_t count, const Choice& barred) const {
    HeldSets remaining = held_;
    remaining.drop(barred);
    Outcome outcome;
    outcome.hopeless = remaining.unionCount() < points_ || mostOf(remaining, count) < points_;
    if (outcome.hopeless) return outcome;
    std::size_t uncovered = points_;
    Choice chosen;
    while (uncovered > 0) {
      if (mostOf(remaining, count - chosen.size()) < uncovered) return outcome;
      const std::size_t best = leading(remaining);
      chosen.push_back(remaining.name(best));
      outcome.first = chosen.front();
      uncovered -= remaining.count(best);
      if (uncovered > 0 && chosen.size() == count) return outcome;
      remaining.take(best);
    }
    outcome.chosen = std::move(chosen);
    return outcome;
  }

 private:
  /// Points that `left` of the candidates can hold at most.
  static std::size_t mostOf(const HeldSets& remaining, std::size_t left) {
    std::vector<std::size_t> sizes(remaining.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = remaining.count(i);
    const std::size_t largest = std::min(left, sizes.size());
    const auto end = sizes.begin() + static_cast<std::ptrdiff_t>(largest);
    std::partial_sort(sizes.begin(), end, sizes.end(), std::greater<>());
    return std::accumulate(sizes.begin(), end, std::size_t{0});
  }

  /// The candidate of highest rank, the first on a tie.
  std::size_t leading(const HeldSets& remaining) const {
    std::size_t best = 0;
    std::pair<std::size_t, std::size_t> bestRank;
    for (std::size_t i = 0; i < remaining.size(); ++i) {
      const std::size_t redundant = rank_ == ExpandRank::maxCover ? 0 : remaining.subsetsOf(i);
      const std::pair rank(redundant, remaining.count(i));
      if (rank <= bestRank) continue;
      best = i;
      bestRank = rank;
    }
    return best;
  }

  HeldSets held_;
  std::size_t points_;
  ExpandRank rank_;
};

/// Least stand-off each candidate needs for each point.
class CostTable {
 public:
  CostTable(const PointSet& points, std::span<const Ball> candidates, ExpandRank rank)
      : points_(points.size()),
        padded_(HeldSets::paddedPoints(points_)),
        rank_(rank),
        costs_(candidates.size() * padded_, std::numeric_limits<double>::infinity()) {
    for (std::size_t i = 0; i < candidates.size(); ++i)
      points.distances(candidates[i].center, candidates[i].depth, std::span(costs_).subspan(i * padded_, points_));
  }

  Selection at(double standOff) const { return {HeldSets(costs_, padded_, standOff), points_, rank_}; }

  /// Stand-off at which some candidate alone holds everything.
  double enoughForOne() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < costs_.size(); i += padded_)
      least = std::min(least, *std::max_element(costs_.begin() + i, costs_.begin() + i + points_));
    return least;
  }

  /// Below this some point is in no candidate.
  double leastFeasible() const {
    std::vector<double> least(points_, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < costs_.size(); i += padded_)
      for (std::size_t p = 0; p < points_; ++p) least[p] = std::min(least[p], costs_[i + p]);
    return std::max(0.0, *std::max_element(least.begin(), least.end()));
  }

 private:
  std::size_t points_, padded_;  // columns of the table, and with its padding
  ExpandRank rank_;
  std::vector<double> costs_;
};

std::vector<Ball> thinned(std::span<const Ball> candidates) {
  const std::size_t count = std::min(candidates.size(), kMaxCandidates);
  std::vector<Ball> kept;
  for (std::size_t k = 0; k < count; ++k) kept.push_back(candidates[k * candidates.size() / count]);
  return kept;
}

PointSet thinned(const PointSet& points) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return PointSet(farthestPointSample(list, kMaxPoints, 0));
}

std::optional<Choice> chooseWithRetries(const Selection& selection, std::size_t count) {
  Choice barred;
  Outcome outcome = selection.choose(count, barred);
  while (!outcome.chosen && !outcome.hopeless && barred.size() < kMaxBarred) {
    barred.push_back(outcome.first);
    outcome = selection.choose(count, barred);
  }
  return std::move(outcome.chosen);
}

/// A choice and the stand-off it was made at.
struct Expanded {
  Choice chosen;
  double standOff = 0;
};

Expanded leastStandOff(const CostTable& costs, std::size_t count) {
  Expanded best;
  best.standOff = costs.enoughForOne();
  double tooLittle = costs.leastFeasible();
  best.chosen = *costs.at(best.standOff).choose(~std::size_t{0}, {}).chosen;
  for (int i = 0; i < kBisections && tooLittle < best.standOff; ++i) {
    const double standOff = 0.5 * (tooLittle + best.standOff);
    if (auto chosen = chooseWithRetries(costs.at(standOff), count)) {
      best = {*std::move(chosen), standOff};
    } else {
      tooLittle = standOff;
    }
  }
  return best;
}

/// Where one ball suffices earlier than the wanted number of smaller ones, as for the cube, the search above can only
/// end with that one. Without balls that hold everything the smaller ones get their turn (5.3.3).
Expanded divided(const CostTable& costs, std::size_t count, Expanded single) {
  double standOff = single.standOff;
  for (int step = 0; step < kMaxSteps; ++step, standOff *= kNextStandOff) {
    const Selection selection = costs.at(standOff);
    if (auto chosen = selection.choose(count, selection.complete()).chosen) return {*std::move(chosen), standOff};
  }
  return single;
}

}  // namespace

SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates, ExpandRank rank) {
  assert(!candidates.empty() && !problem.points.empty());
  const bool all = rank == ExpandRank::maxCover;
  const std::vector<Ball> kept = all ? std::vector<Ball>(candidates.begin(), candidates.end()) : thinned(candidates);
  const PointSet points = all ? problem.points : thinned(problem.points);
  const CostTable costs(points, kept, rank);
  Expanded best = leastStandOff(costs, problem.count);
  if (best.chosen.size() == 1 && problem.count > 1) best = divided(costs, problem.count, std::move(best));
  SphereSet set;
  for (const std::size_t i : best.chosen) set.push_back({kept[i].center, best.standOff + kept[i].depth, kept[i].depth});
  return set;
}

}  // namespace cairn::builder
