// SPDX-License-Identifier: GPL-3.0-or-later
#include "expand.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "spheres/bit_set.h"

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

/// What the candidates hold at one stand-off, and the greedy choice among them.
class Selection {
 public:
  Selection(std::vector<BitSet> held, std::size_t points, ExpandRank rank)
      : held_(std::move(held)), points_(points), rank_(rank) {}

  /// The candidates that alone hold everything.
  Choice complete() const {
    Choice list;
    for (std::size_t i = 0; i < held_.size(); ++i)
      if (held_[i].count() == points_) list.push_back(i);
    return list;
  }

  /// The chosen candidates, or nothing when `count` do not suffice. Candidates in `barred` are left out.
  std::optional<Choice> choose(std::size_t count, const Choice& barred) const {
    std::vector<BitSet> remaining = held_;
    std::vector<std::size_t> alive;
    for (std::size_t i = 0; i < remaining.size(); ++i)
      if (std::find(barred.begin(), barred.end(), i) == barred.end() && !remaining[i].empty()) alive.push_back(i);
    std::size_t uncovered = points_;
    Choice chosen;
    while (uncovered > 0) {
      const std::size_t best = leading(remaining, alive, (count - chosen.size()), uncovered);
      if (best == kNone) return std::nullopt;
      chosen.push_back(best);
      const BitSet taken = remaining[best];
      uncovered -= taken.count();
      if (uncovered > 0 && chosen.size() == count) return std::nullopt;
      for (const std::size_t i : alive) remaining[i].remove(taken);
      std::erase_if(alive, [&](std::size_t i) { return remaining[i].empty(); });
    }
    return chosen;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// The candidate of highest rank; nothing when the largest cannot reach the end in `left` more steps.
  std::size_t leading(const std::vector<BitSet>& remaining, const std::vector<std::size_t>& alive, std::size_t left,
                      std::size_t uncovered) const {
    std::vector<std::size_t> sizes(alive.size());
    std::size_t largest = 0;
    for (std::size_t k = 0; k < alive.size(); ++k) largest = std::max(largest, sizes[k] = remaining[alive[k]].count());
    if (largest == 0 || largest * left < uncovered) return kNone;
    if (rank_ == ExpandRank::maxCover)
      return alive[static_cast<std::size_t>(std::find(sizes.begin(), sizes.end(), largest) - sizes.begin())];
    std::size_t best = kNone;
    std::pair<std::size_t, std::size_t> bestRank;
    for (std::size_t k = 0; k < alive.size(); ++k) {
      std::size_t redundant = 0;
      for (std::size_t m = 0; m < alive.size(); ++m)
        if (sizes[m] <= sizes[k] && remaining[alive[m]].isSubsetOf(remaining[alive[k]])) ++redundant;
      const std::pair rank(redundant, sizes[k]);
      if (best != kNone && rank <= bestRank) continue;
      best = alive[k];
      bestRank = rank;
    }
    return best;
  }

  std::vector<BitSet> held_;
  std::size_t points_;
  ExpandRank rank_;
};

/// Least stand-off each candidate needs for each point.
class CostTable {
 public:
  CostTable(const PointSet& points, std::span<const Ball> candidates, ExpandRank rank)
      : points_(points.size()), rank_(rank), costs_(candidates.size() * points.size()) {
    for (std::size_t i = 0; i < candidates.size(); ++i)
      points.distances(candidates[i].center, candidates[i].depth, std::span(costs_).subspan(i * points_, points_));
  }

  Selection at(double standOff) const {
    std::vector<BitSet> held(points_ == 0 ? 0 : costs_.size() / points_, BitSet(points_));
    for (std::size_t i = 0; i < held.size(); ++i)
      for (std::size_t p = 0; p < points_; ++p)
        if (costs_[i * points_ + p] <= standOff) held[i].insert(p);
    return {std::move(held), points_, rank_};
  }

  /// Stand-off at which some candidate alone holds everything.
  double enoughForOne() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < costs_.size(); i += points_)
      least = std::min(least, *std::max_element(costs_.begin() + i, costs_.begin() + i + points_));
    return least;
  }

  /// Below this some point is in no candidate.
  double leastFeasible() const {
    double needed = 0;
    for (std::size_t p = 0; p < points_; ++p) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = p; i < costs_.size(); i += points_) least = std::min(least, costs_[i]);
      needed = std::max(needed, least);
    }
    return needed;
  }

 private:
  std::size_t points_;
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
  std::optional<Choice> chosen = selection.choose(count, barred);
  while (!chosen && barred.size() < kMaxBarred) {
    const std::optional<Choice> first = selection.choose(~std::size_t{0}, barred);
    if (!first) return std::nullopt;
    barred.push_back(first->front());
    chosen = selection.choose(count, barred);
  }
  return chosen;
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
  best.chosen = *costs.at(best.standOff).choose(~std::size_t{0}, {});
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
    if (auto chosen = selection.choose(count, selection.complete())) return {*std::move(chosen), standOff};
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
