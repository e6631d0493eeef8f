// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "regions/split_region.h"

namespace cairn::builder {

/// A node's division together with the divisions of its children, so that the former can be chosen for the sake of the
/// latter: the tree is greedy level by level, and a set of balls that is best for one level can leave one child with
/// far more than its share of what is difficult.
class Lookahead {
 public:
  /// Takes the division of a node and divides its children.
  Lookahead(Split split, const SignedDistance& solid, const SplitSettings& settings);

  const Split& split() const { return split_; }
  /// Worst error of the children and of the grandchildren.
  double worstChild() const { return split_.worst(); }
  double worstGrandchild() const;

  /// Makes one attempt to lower `worstGrandchild` while no child's error exceeds `limit` or what the split allows (or
  /// what it was): first more effort on the worst child's own division, then seams moved so that its siblings take over
  /// what they can hold as well. False when there is nothing left to attempt. Costs a few divisions. Deterministic.
  bool relieve(double limit, const SignedDistance& solid, const SplitSettings& settings);

  /// Hands over the children's divisions, in the order of `split().children`.
  std::vector<Split> takeChildren() { return std::move(next_); }

 private:
  std::size_t worstIndex() const;
  bool isBalanced() const;
  void searchHarder(std::size_t child, const SignedDistance& solid, const SplitSettings& settings);
  /// The bias that makes every child with more than half of the worst one's error give up surface, the worst most.
  std::vector<double> strongerBias(std::size_t child) const;
  /// The order in which children are divided anew: one that fails the goal ends the attempt, so `child` goes first,
  /// then the one that failed last time, then those that were nearly as bad. What comes of it does not depend on it.
  std::vector<std::size_t> likelyWorstFirst(std::size_t child) const;
  void moveSeams(std::size_t child, double limit, const SignedDistance& solid, const SplitSettings& settings);

  Split split_;
  std::vector<Split> next_;
  std::vector<bool> searched_;            // by child: no more effort to spend on its own division
  std::size_t failed_ = ~std::size_t{0};  // the child that ended the last attempt, if one did
  double step_ = 0;                       // of the next bias, in parts of the stand-off
};

}  // namespace cairn::builder
