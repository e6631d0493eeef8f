// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cairn::builder {

/// The two cheapest balls for a point, among those that may hold it.
struct Holder {
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t ball = kNobody, second = kNobody;
  double cost = std::numeric_limits<double>::infinity(), secondCost = cost;

  /// Considers another ball. Written without branches, because half of them would be mispredicted.
  void offer(std::uint32_t other, double otherCost) {
    const bool first = otherCost < cost, next = otherCost < secondCost;
    second = first ? ball : next ? other : second;
    secondCost = first ? cost : next ? otherCost : secondCost;
    ball = first ? other : ball;
    cost = first ? otherCost : cost;
  }
  /// Sets the cost of ball `i` to `changed`. False when a third ball may now be among the two cheapest. All balls must
  /// then be offered to an empty `Holder`.
  bool update(std::uint32_t i, double changed) {
    if (changed >= secondCost && (ball == i || second == i)) return false;
    if (ball == i)
      cost = changed;
    else
      offer(i, changed);  // to the second it was, that gives its new cost
    return true;
  }
  /// Returns the cost of the cheapest ball other than `i`.
  double without(std::uint32_t i) const { return ball == i ? secondCost : cost; }
};

/// The holders of many points as a structure of arrays, because an optimisation reads all of them for every ball it
/// moves. Lists of points are ascending, without repetition. A list of full length means all points. It is processed
/// several points at a time with the fastest instruction set present; results do not depend on it.
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
  /// By point: its cheapest ball, and the cost of that ball.
  std::span<const std::uint32_t> balls() const { return ball_; }
  std::span<const double> costs() const { return cost_; }

  /// Sets the cost of ball `i` for each point `which[k]` to `costs[k]`. Replaces `open` by those k whose point must be
  /// set anew: see `Holder::update`.
  void update(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs,
              std::vector<std::uint32_t>& open);
  /// Replaces `duties` by those k for which every ball other than `i` costs point `which[k]` more than `goal` and no
  /// less than `costs[k]`.
  void duties(std::uint32_t i, std::span<const std::uint32_t> which, std::span<const double> costs, double goal,
              std::vector<std::uint32_t>& duties) const;

 private:
  std::vector<std::uint32_t> ball_, second_;
  std::vector<double> cost_, secondCost_;
};

}  // namespace cairn::builder
