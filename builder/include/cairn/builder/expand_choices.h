// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "cairn/builder/ball.h"

namespace cairn::builder {

/// Which candidate the greedy choice of Expand takes next (thesis 5.3.3).
enum class ExpandRank : std::uint8_t {
  maxElim,   ///< the one that makes most others redundant, then the one that covers most
  maxCover,  ///< the one that covers most of what is uncovered (Alg. 6 as listed)
};

/// How many balls Expand needs at a stand-off e, when all candidates are grown to r = e + s(c) and a greedy choice
/// takes from them until the points are covered (thesis 5.3.3). Mesh frame and unit.
class ExpandChoices {
 public:
  /// Precondition: neither is empty. A word of memory for each candidate and point.
  ExpandChoices(std::span<const Vec3d> points, std::span<const Ball> candidates, ExpandRank rank);
  ~ExpandChoices();
  /// Moves; the other can only be destroyed or assigned to.
  ExpandChoices(ExpandChoices&&) noexcept;
  /// Moves; the other can only be destroyed or assigned to.
  ExpandChoices& operator=(ExpandChoices&&) noexcept;

  /// Below this some point is in no candidate, whatever is chosen.
  double leastStandOff() const;
  /// At this and above one candidate holds everything.
  double enoughForOne() const;
  /// Balls chosen. With K candidates and N points about K^2 N / 64 word operations for max-elim, K N for max-cover,
  /// once for each ball chosen, falling fast. Precondition: at least `leastStandOff()`.
  std::size_t ballsAt(double standOff) const;
  /// The least stand-off found at which `count` balls or fewer are chosen, by 20 bisections; a choice that fails is
  /// tried again without its first ball. At most 60 choices. Precondition: `count` at least 1.
  double standOffFor(std::size_t count) const;

 private:
  struct Costs;
  std::unique_ptr<Costs> costs_;
};

}  // namespace cairn::builder
