// SPDX-License-Identifier: GPL-3.0-or-later
#include "expand_selection.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace cairn::builder {

namespace {

/// Number of attempts that bar the leading candidate, for shapes whose largest ball prevents a better set (5.3.3).
constexpr int kMaxBarred = 2;

std::optional<Choice> chooseWithRetries(const ExpandSelection& selection, std::size_t count) {
  Choice barred;
  ExpandOutcome outcome = selection.choose(count, barred);
  while (!outcome.chosen && !outcome.hopeless && barred.size() < kMaxBarred) {
    barred.push_back(outcome.first);
    outcome = selection.choose(count, barred);
  }
  return std::move(outcome.chosen);
}

}  // namespace

ExpandSelection::ExpandSelection(HeldSets held, std::size_t points, ExpandRank rank)
    : held_(std::move(held)), points_(points), rank_(rank) {}

Choice ExpandSelection::complete() const {
  Choice list;
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_.count(i) == points_) list.push_back(i);
  return list;
}

ExpandOutcome ExpandSelection::choose(std::size_t count, const Choice& barred) const {
  HeldSets remaining = held_;
  remaining.drop(barred);
  ExpandOutcome outcome;
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

/// Largest number of points that `left` of the candidates can hold.
std::size_t ExpandSelection::mostOf(const HeldSets& remaining, std::size_t left) {
  std::vector<std::size_t> sizes(remaining.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = remaining.count(i);
  const std::size_t largest = std::min(left, sizes.size());
  const auto end = sizes.begin() + static_cast<std::ptrdiff_t>(largest);
  std::partial_sort(sizes.begin(), end, sizes.end(), std::greater<>());
  return std::accumulate(sizes.begin(), end, std::size_t{0});
}

/// The candidate of highest rank, the first on a tie.
std::size_t ExpandSelection::leading(const HeldSets& remaining) const {
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

ExpandCosts::ExpandCosts(const PointSet& points, std::span<const Ball> candidates, ExpandRank rank)
    : points_(points.size()),
      padded_(HeldSets::paddedPoints(points_)),
      rank_(rank),
      costs_(candidates.size() * padded_, std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < candidates.size(); ++i)
    points.distances(candidates[i].center, candidates[i].depth, std::span(costs_).subspan(i * padded_, points_));
}

ExpandSelection ExpandCosts::at(double standOff) const {
  return {HeldSets(costs_, padded_, standOff), points_, rank_};
}

double ExpandCosts::enoughForOne() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < costs_.size(); i += padded_)
    least = std::min(least, *std::max_element(costs_.begin() + i, costs_.begin() + i + points_));
  return least;
}

double ExpandCosts::leastFeasible() const {
  std::vector<double> least(points_, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < costs_.size(); i += padded_)
    for (std::size_t p = 0; p < points_; ++p) least[p] = std::min(least[p], costs_[i + p]);
  return std::max(0.0, *std::max_element(least.begin(), least.end()));
}

Expanded ExpandCosts::leastFor(std::size_t count, int bisections) const {
  Expanded best;
  best.standOff = enoughForOne();
  double tooLittle = leastFeasible();
  best.chosen = *at(best.standOff).choose(~std::size_t{0}, {}).chosen;
  for (int i = 0; i < bisections && tooLittle < best.standOff; ++i) {
    const double standOff = 0.5 * (tooLittle + best.standOff);
    if (auto chosen = chooseWithRetries(at(standOff), count)) {
      best = {*std::move(chosen), standOff};
    } else {
      tooLittle = standOff;
    }
  }
  return best;
}

}  // namespace cairn::builder
