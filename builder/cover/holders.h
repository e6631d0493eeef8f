// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cairn::builder {

/// The two cheapest balls for a point, of those that may hold it.
struct Holder {
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t ball = kNobody, second = kNobody;
  double cost = std::numeric_limits<double>::infinity(), secondCost = cost;

  /// Without branches, of which half would be mispredicted.
  void offer(std::uint32_t other, double otherCost) {
    const bool first = otherCost < cost, next = otherCost < secondCost;
    second = first ? ball : next ? other : second;
    secondCost = first ? cost : next ? otherCost : secondCost;
    ball = first ? other : ball;
    cost = first ? otherCost : cost;
  }
  /// Ball `i` costs `changed` now. False when a third ball may be among the two cheapest, so that all have to be
  /// offered to an empty one.
  bool update(std::uint32_t i, double changed) {
    if (changed >= secondCost && (ball == i || second == i)) return false;
    if (ball == i)
      cost = changed;
    else
      offer(i, changed);  // to the second it was, that gives its new cost
    return true;
  }
  /// What the cheapest ball but `i` costs.
  double without(std::uint32_t i) const { return ball == i ? secondCost : cost; }
};

/// The holders of many points as structure of arrays: an optimisation looks at all of them for every ball it moves.
/// Lists of points are ascending, each once; a list of as many as there are is all of them, and gone through several at
/// a time with the fastest instruction set present, with the same result on every one.
class Holders {
 public:
  explicit Holders(std::size_t points)
      : ball_(points, Holder::kNobody), second_(ball_), cost_(points, Holder{}.cost), secondCost_(cost_) {}

  std::size_t size() const { return cost_.size(); }
  Holder at(std::size_t point) const { return {ball_[point], second_[point], cost_[point], secondCost_[point]}; }
  void set(std::size_t point, const Holder& holder) {
    ball_[point] = holder.ball;
    second_[point] = holder.second;
    cost_[point] = holder.cost;
    secondCost_[point] = holder.secondCost;
  }
  /// By point: its cheapest ball, and what that costs.
  std::span<const std::uint32_t> balls() const { return ball_; }
  std::span<const double> costs() const { return cost_; }

  /// Ball `i` costs `costs[k]` for point `which[k]` now. Replaces `open` by those k whose point has to be set anew: see
  /// `Holder::update`.
  void update(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs,
              std::vector<std::uint32_t>& open);
  /// Replaces `duties` by those k for which any ball but `i` costs point `which[k]` more than `goal` and no less than
  /// `costs[k]`.
  void duties(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs, double goal,
              std::vector<std::uint32_t>& duties) const;

 private:
  std::vector<std::uint32_t> ball_, second_;
  std::vector<double> cost_, secondCost_;
};

}  // namespace cairn::builder
