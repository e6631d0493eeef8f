// SPDX-License-Identifier: GPL-3.0-or-later
#include "relieve_level.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "balls/sphere_set.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

constexpr std::uint32_t kNowhere = ~0U;

/// The saving of the worst stand-off that a step requests, and the saving it needs to be kept. A small request lets
/// families outside hold most points.
constexpr double kRequest = 0.02, kWorthAStep = 0.002;
/// Least number of families optimised together: those that may hold the worst point, filled up to this number.
constexpr std::size_t kFamilies = 3;
/// Number of balls removed in turn before the family is started anew.
constexpr std::size_t kSwaps = 12;

/// A few families of a level, with the points that remain for them.
struct Part {
  std::vector<std::uint32_t> parents;             // of the level, by parent of the part
  PointSet points;                                // no family outside holds them within the goal
  std::vector<std::vector<std::uint32_t>> reach;  // by parent of the part
  std::vector<ChildBall> balls;                   // by parent of the part
};

/// The cheapest ball for a point, and the cost of the second cheapest.
struct Holder {
  std::size_t ball = 0;
  double cost = kInfinity, secondCost = kInfinity;
};

/// Balls, ordered by the largest cost of their points for the other balls.
std::vector<std::size_t> mostDispensableFirst(const Part& part) {
  std::vector<Holder> holders(part.points.size());
  for (std::size_t i = 0; i < part.balls.size(); ++i)
    for (const std::uint32_t p : part.reach[part.balls[i].parent]) {
      Holder& holder = holders[p];
      const double cost = costOf(part.balls[i].ball, part.points[p]);
      if (cost < holder.cost)
        holder = {i, cost, holder.cost};
      else
        holder.secondCost = std::min(holder.secondCost, cost);
    }
  std::vector<double> price(part.balls.size(), -kInfinity);
  for (const Holder& holder : holders)
    if (holder.cost < kInfinity) price[holder.ball] = std::max(price[holder.ball], holder.secondCost);
  std::vector<std::size_t> order(part.balls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return price[a] < price[b]; });
  return order;
}

class Relief {
 public:
  Relief(const LevelProblem& problem, const std::vector<ChildBall>& level)
      : problem_(problem), families_(problem.reach.size()), costs_(problem.reach.size()) {
    for (const ChildBall& child : level) families_[child.parent].push_back(child.ball);
    for (std::uint32_t k = 0; k < families_.size(); ++k) {
      reachPoints_.emplace_back();
      for (const std::uint32_t p : problem.reach[k]) reachPoints_.back().push(problem.points[p]);
      measure(k);
    }
  }

  void run(const ReliefEffort& effort) {
    attempts_ = effort.attempts;
    redraws_ = effort.redraws;
    while (attempts_ > 0 && problem_.goesOn()) {
      const std::vector<double> least = leastCosts({});
      const auto worst = std::max_element(least.begin(), least.end());
      if (*worst <= problem_.enough || !relieve(static_cast<std::uint32_t>(worst - least.begin()), *worst)) return;
    }
  }

  std::vector<ChildBall> level() const {
    std::vector<ChildBall> level;
    for (std::uint32_t k = 0; k < families_.size(); ++k)
      for (const Ball& ball : families_[k]) level.push_back({ball, k});
    return level;
  }

 private:
  void measure(std::uint32_t k) {
    costs_[k].assign(problem_.reach[k].size(), kInfinity);
    std::vector<double> row(costs_[k].size());
    for (const Ball& ball : families_[k]) {
      reachPoints_[k].distances(ball.center, ball.depth, row);
      std::transform(row.begin(), row.end(), costs_[k].begin(), costs_[k].begin(),
                     [](double a, double b) { return std::min(a, b); });
    }
  }

  /// By point: the least cost over all families except the named ones (ascending).
  std::vector<double> leastCosts(const std::vector<std::uint32_t>& but) const {
    std::vector<double> least(problem_.points.size(), kInfinity);
    for (std::uint32_t k = 0; k < families_.size(); ++k) {
      if (std::binary_search(but.begin(), but.end(), k)) continue;
      for (std::size_t i = 0; i < costs_[k].size(); ++i) {
        double& cost = least[problem_.reach[k][i]];
        cost = std::min(cost, costs_[k][i]);
      }
    }
    return least;
  }

  /// The parents that reach the point and, up to `kFamilies`, those that share most points with these; ascending.
  std::vector<std::uint32_t> parentsAround(std::uint32_t point) const {
    std::vector<std::uint32_t> parents;
    std::vector<char> reached(problem_.points.size(), 0);
    for (std::uint32_t k = 0; k < families_.size(); ++k) {
      if (!std::binary_search(problem_.reach[k].begin(), problem_.reach[k].end(), point)) continue;
      parents.push_back(k);
      for (const std::uint32_t p : problem_.reach[k]) reached[p] = 1;
    }
    std::vector<std::pair<std::ptrdiff_t, std::uint32_t>> sharing;  // number of shared points, and the parent
    for (std::uint32_t k = 0; k < families_.size(); ++k) {
      if (std::find(parents.begin(), parents.end(), k) != parents.end()) continue;
      const auto shared = std::ranges::count_if(problem_.reach[k], [&](std::uint32_t p) { return reached[p] != 0; });
      if (shared > 0) sharing.emplace_back(-shared, k);
    }
    std::sort(sharing.begin(), sharing.end());
    for (std::size_t i = 0; i < sharing.size() && parents.size() < kFamilies; ++i) parents.push_back(sharing[i].second);
    std::sort(parents.begin(), parents.end());
    return parents;
  }

  /// The points that remain for these families; families without such points are left out.
  Part partOf(const std::vector<std::uint32_t>& parents, double goal) const {
    const std::vector<double> outside = leastCosts(parents);
    std::vector<char> left(problem_.points.size(), 0);
    for (const std::uint32_t k : parents)
      for (const std::uint32_t p : problem_.reach[k]) left[p] = outside[p] > goal ? 1 : 0;
    std::vector<std::uint32_t> place(left.size(), kNowhere);
    Part part;
    for (std::uint32_t p = 0; p < left.size(); ++p) {
      if (left[p] == 0) continue;
      place[p] = static_cast<std::uint32_t>(part.points.size());
      part.points.push(problem_.points[p]);
    }
    for (const std::uint32_t k : parents) {
      std::vector<std::uint32_t> reach;
      for (const std::uint32_t p : problem_.reach[k])
        if (place[p] != kNowhere) reach.push_back(place[p]);
      if (reach.empty()) continue;
      const auto parent = static_cast<std::uint32_t>(part.parents.size());
      for (const Ball& ball : families_[k]) part.balls.push_back({ball, parent});
      part.parents.push_back(k);
      part.reach.push_back(std::move(reach));
    }
    return part;
  }

  /// One step. False when it does not lower the cost of the point for the families around it.
  bool relieve(std::uint32_t point, double worst) {
    const double goal = std::max(problem_.enough, worst * (1 - kRequest));
    const Part part = partOf(parentsAround(point), goal);
    std::optional<std::vector<ChildBall>> found = better(part, part.balls, goal, worst);
    const std::vector<std::size_t> order = mostDispensableFirst(part);
    for (std::size_t n = 0; n < std::min(kSwaps, order.size()) && !found && attempts_ > 0 && problem_.goesOn(); ++n) {
      std::vector<ChildBall> fewer = part.balls;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(order[n]));
      found = better(part, std::move(fewer), goal, worst);
    }
    if (!found && redraws_ > 0) found = redrawn(part, goal, worst);
    if (!found) return false;
    for (const std::uint32_t k : part.parents) families_[k].clear();
    for (const ChildBall& child : *found) families_[part.parents[child.parent]].push_back(child.ball);
    for (const std::uint32_t k : part.parents) measure(k);
    return true;
  }

  /// Starts the family with the most to gain anew, from first balls spread over its reach.
  std::optional<std::vector<ChildBall>> redrawn(const Part& part, double goal, double worst) {
    const std::uint32_t k = mostStrained(part);
    PointSet reached;
    for (const std::uint32_t p : part.reach[k]) reached.push(part.points[p]);
    std::vector<ChildBall> others;
    std::ranges::copy_if(part.balls, std::back_inserter(others), [&](const ChildBall& c) { return c.parent != k; });
    const PointSet firsts = evenSample(reached, redraws_, 0);
    std::optional<std::vector<ChildBall>> found;
    for (std::size_t n = 0; n < firsts.size() && !found && attempts_ > 0 && problem_.goesOn(); ++n) {
      std::vector<ChildBall> start = others;
      start.push_back({{firsts[n], 0, problem_.solid.depth(firsts[n])}, k});
      found = better(part, std::move(start), goal, worst);
    }
    return found;
  }

  static std::uint32_t mostStrained(const Part& part) {
    std::vector<double> least(part.points.size(), kInfinity);
    for (const ChildBall& child : part.balls)
      for (const std::uint32_t p : part.reach[child.parent])
        least[p] = std::min(least[p], costOf(child.ball, part.points[p]));
    const auto worst = static_cast<std::uint32_t>(std::max_element(least.begin(), least.end()) - least.begin());
    std::uint32_t k = 0;
    while (!std::ranges::binary_search(part.reach[k], worst)) ++k;
    return k;
  }

  /// One attempt: optimises the part's families from a start, if that can be worth a step.
  std::optional<std::vector<ChildBall>> better(const Part& part, std::vector<ChildBall> start, double goal,
                                               double worst) {
    --attempts_;
    const LevelProblem local{part.points, problem_.solid,       part.reach,        problem_.branching,
                             goal,        problem_.worthARound, problem_.keepGoing};
    std::vector<ChildBall> trial = optimiseLevel(local, std::move(start));
    if (coverStandOff(local, trial) >= worst * (1 - kWorthAStep)) return std::nullopt;
    return trial;
  }

  const LevelProblem& problem_;
  std::size_t attempts_ = 0;                // attempts left
  std::size_t redraws_ = 0;                 // of a family, before a point is given up
  std::vector<SphereSet> families_;         // by parent
  std::vector<std::vector<double>> costs_;  // by parent, by slot of its reach: cost of its family's cheapest ball
  std::vector<PointSet> reachPoints_;       // by parent
};

}  // namespace

std::vector<ChildBall> relieveLevel(const LevelProblem& problem, const std::vector<ChildBall>& level,
                                    const ReliefEffort& effort) {
  Relief relief(problem, level);
  relief.run(effort);
  return relief.level();
}

}  // namespace cairn::builder
