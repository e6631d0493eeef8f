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

/// Candidates by their index.
using Choice = std::vector<std::size_t>;

/// What a greedy choice among candidates came to.
struct ExpandOutcome {
  std::optional<Choice> chosen;  ///< nothing when the balls do not suffice
  std::size_t first = 0;         ///< the candidate it began with
  bool hopeless = false;         ///< no choice of as many candidates can suffice
};

/// What the candidates hold at one stand-off, and the greedy choice among them (thesis 5.3.3).
class ExpandSelection {
 public:
  ExpandSelection(HeldSets held, std::size_t points, ExpandRank rank);

  /// The candidates that alone hold everything.
  Choice complete() const;
  /// At most `count` candidates, without those `barred`.
  ExpandOutcome choose(std::size_t count, const Choice& barred) const;

 private:
  static std::size_t mostOf(const HeldSets& remaining, std::size_t left);
  std::size_t leading(const HeldSets& remaining) const;

  HeldSets held_;
  std::size_t points_;
  ExpandRank rank_;
};

/// A choice and the stand-off it was made at.
struct Expanded {
  Choice chosen;
  double standOff = 0;
};

/// Least stand-off each candidate needs for each point.
class ExpandCosts {
 public:
  /// Precondition: neither is empty. A word for each candidate and point.
  ExpandCosts(const PointSet& points, std::span<const Ball> candidates, ExpandRank rank);

  ExpandSelection at(double standOff) const;
  /// Stand-off at which some candidate alone holds everything.
  double enoughForOne() const;
  /// Below this some point is in no candidate.
  double leastFeasible() const;
  /// The least stand-off found to need no more than `count` balls, by so many halvings of what is left between none
  /// and enough for one. A choice that fails is tried again without its first ball.
  Expanded leastFor(std::size_t count, int bisections) const;

 private:
  std::size_t points_, padded_;  // columns of the table, and with its padding
  ExpandRank rank_;
  std::vector<double> costs_;
};

}  // namespace cairn::builder
