// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "balls/point_set.h"
#include "cairn/builder/expand_choices.h"
#include "spheres/held_sets.h"

namespace cairn::builder {

/// Candidates, by index.
using Choice = std::vector<std::size_t>;

/// The result of a greedy choice among candidates.
struct ExpandOutcome {
  std::optional<Choice> chosen;  ///< nothing when the balls do not suffice
  std::size_t first = 0;         ///< the first candidate of the choice
  bool hopeless = false;         ///< no choice of this many candidates can suffice
};

/// The points that the candidates hold at one stand-off, and the greedy choice among them (thesis 5.3.3).
class ExpandSelection {
 public:
  ExpandSelection(HeldSets held, std::size_t points, ExpandRank rank);

  /// Returns the candidates that alone hold all points.
  Choice complete() const;
  /// Chooses at most `count` candidates, none of them from `barred`.
  ExpandOutcome choose(std::size_t count, const Choice& barred) const;

 private:
  static std::size_t mostOf(const HeldSets& remaining, std::size_t left);
  std::size_t leading(const HeldSets& remaining) const;

  HeldSets held_;
  std::size_t points_;
  ExpandRank rank_;
};

/// A choice and its stand-off.
struct Expanded {
  Choice chosen;
  double standOff = 0;
};

/// The least stand-off that each candidate needs for each point.
class ExpandCosts {
 public:
  /// Precondition: neither is empty. Memory: one word for each candidate and point.
  ExpandCosts(const PointSet& points, std::span<const Ball> candidates, ExpandRank rank);

  ExpandSelection at(double standOff) const;
  /// Returns the stand-off at which some candidate alone holds all points.
  double enoughForOne() const;
  /// Below this stand-off some point lies in no candidate.
  double leastFeasible() const;
  /// Returns the least stand-off found that needs no more than `count` balls. `bisections` halve the interval between
  /// `leastFeasible` and `enoughForOne`. A choice that fails is tried again without its first ball.
  Expanded leastFor(std::size_t count, int bisections) const;

 private:
  std::size_t points_, padded_;  // columns of the table, without and with padding
  ExpandRank rank_;
  std::vector<double> costs_;
};

}  // namespace cairn::builder
