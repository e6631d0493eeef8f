// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "cairn/builder/ball.h"

namespace cairn::builder {

/// The rule by which the greedy choice of Expand takes its next candidate (thesis 5.3.3).
enum class ExpandRank : std::uint8_t {
  maxElim,   ///< the candidate that makes most others redundant; among equals, the one that covers most
  maxCover,  ///< the candidate that covers most of the uncovered points (Alg. 6 as listed)
};

/// Counts the balls that Expand needs at a stand-off e (thesis 5.3.3). All candidates grow to r = e + s(c). A greedy
/// choice then takes candidates until the points are covered. Mesh frame and unit.
///
///     ExpandChoices choices(points, axis.balls(), ExpandRank::maxElim);
///     double standOff = choices.standOffFor(8);
class ExpandChoices {
 public:
  /// Precondition: neither span is empty. Memory: one word for each pair of a candidate and a point.
  ExpandChoices(std::span<const Vec3d> points, std::span<const Ball> candidates, ExpandRank rank);
  ~ExpandChoices();
  /// Moves; the source can then only be destroyed or assigned to.
  ExpandChoices(ExpandChoices&&) noexcept;
  /// Moves; the source can then only be destroyed or assigned to.
  ExpandChoices& operator=(ExpandChoices&&) noexcept;

  /// Below this stand-off some point lies in no candidate, whatever is chosen.
  double leastStandOff() const;
  /// At this stand-off and above, one candidate holds all points.
  double enoughForOne() const;
  /// Returns the number of balls chosen. Precondition: `standOff` is at least `leastStandOff()`. With K candidates and
  /// N points, each chosen ball costs about K^2 N / 64 word operations for max-elim and K N for max-cover. The cost
  /// falls fast from ball to ball.
  std::size_t ballsAt(double standOff) const;
  /// Returns the least stand-off found at which at most `count` balls are chosen, by 20 bisections. A choice that fails
  /// is tried again without its first ball. Cost: at most 60 choices. Precondition: `count` is at least 1.
  double standOffFor(std::size_t count) const;

 private:
  struct Costs;
  std::unique_ptr<Costs> costs_;
};

}  // namespace cairn::builder
