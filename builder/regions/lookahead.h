// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "regions/split_region.h"

namespace cairn::builder {

/// A node's division together with the divisions of its children, so that the first can be chosen in favour of the
/// others. The tree is greedy level by level. The best set of balls for one level can leave one child with far more
/// than its share of difficult surface.
///
///     Lookahead lookahead(splitRegion(region, solid, settings, 1), solid, settings);
///     while (lookahead.relieve(limit, solid, settings)) {}
class Lookahead {
 public:
  /// Takes the division of a node and divides its children.
  Lookahead(Split split, const SignedDistance& solid, const SplitSettings& settings);

  const Split& split() const { return split_; }
  /// Worst error of the children and of the grandchildren.
  double worstChild() const { return split_.worst(); }
  double worstGrandchild() const;

  /// Makes one attempt to lower `worstGrandchild`. No child's error may exceed the smaller of `limit` and the split's
  /// `allowed`, or the present worst error where that is larger already. First the worst child's own division gets more
  /// effort. Then seams move, so that its siblings take over surface that they hold as well. False when there is
  /// nothing left to attempt. Costs a few divisions. Deterministic.
  bool relieve(double limit, const SignedDistance& solid, const SplitSettings& settings);

  /// Returns the children's divisions, in the order of `split().children`. Call it once, at the end.
  std::vector<Split> takeChildren() { return std::move(next_); }

 private:
  std::size_t worstIndex() const;
  bool isBalanced() const;
  void searchHarder(std::size_t child, const SignedDistance& solid, const SplitSettings& settings);
  /// Returns the bias by which every child with more than half of the worst child's error gives up surface; the worst
  /// child gives up most.
  std::vector<double> strongerBias(std::size_t child) const;
  /// Returns the order in which children are divided anew. A child that fails the goal ends the attempt. So `child`
  /// goes first, then the one that failed last time, then those that were nearly as bad. The result does not depend on
  /// the order.
  std::vector<std::size_t> likelyWorstFirst(std::size_t child) const;
  void moveSeams(std::size_t child, double limit, const SignedDistance& solid, const SplitSettings& settings);

  Split split_;
  std::vector<Split> next_;
  std::vector<bool> searched_;            // by child: its own division needs no more effort
  std::size_t failed_ = ~std::size_t{0};  // the child that ended the last attempt, if any
  double step_ = 0;                       // of the next bias, as a fraction of the stand-off
};

}  // namespace cairn::builder
