// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "cairn/core/budget.h"
#include "volumes/overlap.h"

namespace cairn::bench {

/// A node as the traversal reads it.
template <class Volume>
struct TraversedNode {
  Volume volume;
  double error = 0;
  std::uint32_t firstChild = 0;  ///< of two; 0: none
};
template <class Volume>
using TraversedTree = std::vector<TraversedNode<Volume>>;

/// Tests of two balls that a pair test costs; of two kinds the dearer one's.
inline double pairCost(const PlainBall&, const PlainBall&) {
  return 1;
}
inline double pairCost(const SweptBall& a, const SweptBall& b) {
  return kPairCost[static_cast<std::size_t>(std::max(a.kind, b.kind))];
}

/// What a traversal did, and what it was left with.
struct PairWork {
  std::uint64_t tests = 0, moves = 0;
  double cost = 0;        ///< of the tests, in tests of two balls
  double worstError = 0;  ///< both errors together, of the worst pair found or waiting; mesh unit
  /// Thesis, Eq. 2.1, whatever the volume.
  std::uint64_t operations() const { return kOverlapTestCost * tests + kSphereUpdateCost * moves; }
};

/// The staircase traversal with one volume for another: the pair waiting longest, the node that errs more is split, the
/// other one is moved into its frame and tested against both children. Ends at nodes that err at most `error`, or once
/// the tests have cost `mostCost`. Keeps its lists, so that a second run allocates nothing.
template <class Volume>
class PairTraversal {
 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  /// `bToA` places b in the frame of a, `aToB` the other way; all points lie within `lengths` of either's origin.
  PairWork run(const TraversedTree<Volume>& a, const TraversedTree<Volume>& b, const RigidMove& bToA,
               const RigidMove& aToB, double error, double lengths,
               double mostCost = std::numeric_limits<double>::infinity()) {
    const double slack = overlapSlack(lengths);
    PairWork work{1, 1, pairCost(a[0].volume, b[0].volume), 0};
    queue_.clear();
    found_.clear();
    if (mayMeet(a[0].volume, bToA * b[0].volume, slack)) queue_.push_back({0, 0});
    std::size_t head = 0;
    for (; head < queue_.size() && work.cost < mostCost; ++head) {
      const auto [i, j] = queue_[head];
      const TraversedNode<Volume>&nodeA = a[i], &nodeB = b[j];
      const bool endsA = nodeA.error <= error || nodeA.firstChild == 0;
      const bool endsB = nodeB.error <= error || nodeB.firstChild == 0;
      if (endsA && endsB) {
        found_.push_back({i, j});
        continue;
      }
      const bool splitsA = endsB || (!endsA && nodeA.error >= nodeB.error);
      const Volume other = splitsA ? bToA * nodeB.volume : aToB * nodeA.volume;
      const std::uint32_t first = splitsA ? nodeA.firstChild : nodeB.firstChild;
      const TraversedTree<Volume>& split = splitsA ? a : b;
      for (std::uint32_t child = first; child < first + 2; ++child) {
        if (mayMeet(split[child].volume, other, slack))
          queue_.push_back(splitsA ? std::pair{child, j} : std::pair{i, child});
        work.cost += pairCost(split[child].volume, other);
      }
      work.tests += 2;
      ++work.moves;
    }
    const auto look = [&](const auto& pair) {
      work.worstError = std::max(work.worstError, a[pair.first].error + b[pair.second].error);
    };
    std::for_each(queue_.begin() + static_cast<std::ptrdiff_t>(head), queue_.end(), look);
    std::for_each(found_.begin(), found_.end(), look);
    return work;
  }

  /// Pairs of nodes that end the traversal and may meet.
  const Pairs& found() const { return found_; }

 private:
  Pairs queue_, found_;
};

}  // namespace cairn::bench
