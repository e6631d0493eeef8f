// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_cover.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "balls/ball_fit.h"
#include "cover/holders.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

constexpr double kFirstRequest = 0.1;  ///< fraction of the worst stand-off that a round first tries to save
constexpr int kSweepsPerRound = 3;
constexpr int kMaxRounds = 40;
/// First and finest step of a centre, as fractions of the requested stand-off.
constexpr double kCoarsestStep = 0.3, kFinestStep = 0.01;
/// A ball that needs at most this fraction of the requested stand-off stays.
constexpr double kEase = 0.8;

/// The position of a point in a parent's reach.
struct Place {
  std::uint32_t parent = 0, slot = 0;
};

/// By point: its positions, in the order of the parents.
class Places {
 public:
  Places(std::size_t points, std::span<const std::vector<std::uint32_t>> reach) : begin_(points + 1, 0) {
    for (const auto& list : reach)
      for (const std::uint32_t p : list) ++begin_[p + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    places_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t parent = 0; parent < reach.size(); ++parent)
      for (std::uint32_t slot = 0; slot < reach[parent].size(); ++slot)
        places_[next[reach[parent][slot]]++] = {parent, slot};
  }
  std::span<const Place> of(std::size_t point) const {
    return std::span(places_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Place> places_;
};

/// The state of a ball after a descent that found no lower stand-off. The same descent would fail again.
struct Stuck {
  Vec3d center;
  double goal = 0;
  std::vector<std::uint32_t> duties;

  bool at(const Vec3d& c, double g, const std::vector<std::uint32_t>& d) const {
    return g == goal && c == center && d == duties;
  }
};

class LevelOptimisation {
 public:
  LevelOptimisation(const LevelProblem& problem, std::vector<ChildBall> balls)
      : problem_(problem),
        balls_(std::move(balls)),
        places_(problem.points.size(), problem.reach),
        family_(problem.reach.size()),
        holders_(problem.points.size()) {
    for (const auto& list : problem.reach) reachPoints_.emplace_back().assign(problem.points, list);
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      enlist(i);
      updateCosts(i);
    }
  }

  void fillFamilies() {
    for (std::size_t round = 1; round <= problem_.branching; ++round)
      for (std::uint32_t parent = 0; parent < family_.size(); ++parent) {
        if (family_[parent].size() >= round || problem_.reach[parent].empty()) continue;
        balls_.push_back({{}, parent});
        const auto added = static_cast<std::uint32_t>(balls_.size() - 1);
        enlist(added);
        joinWorst(added);
      }
  }

  double worstCost() const {
    double worst = -kInfinity;
    for (const double cost : holders_.costs()) worst = std::max(worst, cost);
    return worst;
  }

  void run() {
    double worst = worstCost();
    double request = kFirstRequest;
    for (int round = 0; round < kMaxRounds && request >= problem_.worthARound && worst > problem_.enough; ++round) {
      if (!problem_.goesOn()) return;
      save();
      const double goal = std::max(problem_.enough, worst * (1 - request));
      double reached = worst;
      for (int s = 0; s < kSweepsPerRound && reached > goal && problem_.goesOn(); ++s) {
        if (!sweep(goal)) break;
        reached = worstCost();
      }
      if (reached >= worst) restore();
      if (reached > goal) request *= 0.5;
      worst = std::min(worst, reached);
    }
  }

  std::vector<ChildBall> settled() const {
    const std::vector<double> load = loads();
    std::vector<ChildBall> level;
    for (const auto& family : family_)
      for (const std::uint32_t i : family)
        if (load[i] > -kInfinity) {
          const Ball& ball = balls_[i].ball;
          level.push_back({{ball.center, load[i] + ball.depth, ball.depth}, balls_[i].parent});
        }
    return level;
  }

 private:
  /// The ball joins its family, and holds nothing yet.
  void enlist(std::uint32_t i) {
    const std::uint32_t parent = balls_[i].parent;
    family_[parent].push_back(i);
    costs_.resize(balls_.size());
    savedCosts_.resize(balls_.size());
    changed_.resize(balls_.size(), 0);
    stuck_.resize(balls_.size());
    costs_[i].assign(problem_.reach[parent].size(), kInfinity);
  }

  /// Stores the positions of all balls. Their costs are stored when they change.
  void save() {
    savedBalls_ = balls_;
    savedHolders_ = holders_;
    std::fill(changed_.begin(), changed_.end(), char{0});
  }

  void restore() {
    std::swap(balls_, savedBalls_);
    std::swap(holders_, savedHolders_);
    for (std::size_t i = 0; i < costs_.size(); ++i)
      if (changed_[i] != 0) std::swap(costs_[i], savedCosts_[i]);
  }

  void updateCosts(std::uint32_t i) {
    const Ball& ball = balls_[i].ball;
    const std::vector<std::uint32_t>& reach = problem_.reach[balls_[i].parent];
    if (changed_[i] == 0) {
      std::swap(costs_[i], savedCosts_[i]);
      costs_[i].resize(reach.size());
      changed_[i] = 1;
    }
    reachPoints_[balls_[i].parent].distances(ball.center, ball.depth, costs_[i]);
    holders_.update(i, reach, costs_[i], open_);
    for (const std::uint32_t slot : open_) holders_.set(reach[slot], holderOf(reach[slot]));
  }

  Holder holderOf(std::size_t point) const {
    Holder holder;
    for (const Place& place : places_.of(point))
      for (const std::uint32_t i : family_[place.parent]) holder.offer(i, costs_[i][place.slot]);
    return holder;
  }

  /// By ball: the largest cost of the points that it holds most cheaply; minus infinity without any.
  std::vector<double> loads() const {
    std::vector<double> load(balls_.size(), -kInfinity);
    for (std::size_t p = 0; p < holders_.size(); ++p)
      if (const std::uint32_t ball = holders_.balls()[p]; ball != Holder::kNobody)
        load[ball] = std::max(load[ball], holders_.costs()[p]);
    return load;
  }

  /// False when all balls stayed. They would stay in the next sweep too.
  bool sweep(double goal) {
    const std::vector<double> load = loads();
    std::vector<std::uint32_t> order(balls_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return load[a] > load[b]; });
    bool moved = false;
    for (const std::uint32_t i : order) moved = move(i, goal) || moved;
    return moved;
  }

  /// False when the ball stays.
  bool move(std::uint32_t i, double goal) {
    // Returns slots of the ball's reach whose points no other ball holds at the stand-off `goal` or more cheaply.
    holders_.duties(i, problem_.reach[balls_[i].parent], costs_[i], goal, duties_);
    if (duties_.empty()) {
      joinWorst(i);
      return true;
    }
    Ball& ball = balls_[i].ball;
    if (stuck_[i].at(ball.center, goal, duties_)) return false;
    dutyPoints_.assign(reachPoints_[balls_[i].parent], duties_);
    const Ball needed{ball.center, dutyPoints_.farthest(ball.center).distance, ball.depth};
    if (needed.standOff() <= kEase * goal) return false;
    const Ball lowest = descend(needed, dutyPoints_, problem_.solid, kCoarsestStep * goal, kFinestStep * goal, memory_);
    if (lowest.center == ball.center && lowest.depth == ball.depth) {
      stuck_[i] = {ball.center, goal, duties_};
      return false;
    }
    ball = lowest;
    updateCosts(i);
    return true;
  }

  /// Moves an idle ball to the worst covered point of its parent's reach, where it will take over a share.
  void joinWorst(std::uint32_t i) {
    const std::vector<std::uint32_t>& reach = problem_.reach[balls_[i].parent];
    std::uint32_t worst = reach.front();
    const std::span<const double> costs = holders_.costs();
    for (const std::uint32_t p : reach)
      if (costs[p] > costs[worst]) worst = p;
    const std::uint32_t owner = holders_.balls()[worst];
    Vec3d center = problem_.points[worst];
    if (owner != Holder::kNobody) center = (center + balls_[owner].ball.center) * 0.5;
    balls_[i].ball = {center, 0, problem_.solid.depth(center)};
    updateCosts(i);
  }

  const LevelProblem& problem_;
  std::vector<ChildBall> balls_;
  Places places_;
  std::vector<PointSet> reachPoints_;               // by parent
  std::vector<std::vector<std::uint32_t>> family_;  // by parent: its balls
  std::vector<std::vector<double>> costs_;          // by ball, then by slot of its parent's reach
  Holders holders_;
  std::vector<Stuck> stuck_;  // by ball: its last failed descent, if any; the duties are then not empty
  // State at the begin of the round; costs only of the balls in `changed_`.
  std::vector<ChildBall> savedBalls_;
  std::vector<std::vector<double>> savedCosts_;
  Holders savedHolders_{0};
  std::vector<char> changed_;
  // Scratch of one move, kept to save allocations.
  std::vector<std::uint32_t> open_, duties_;
  PointSet dutyPoints_;
  StandOffMemory memory_;
};

}  // namespace

double coverStandOff(const LevelProblem& problem, std::span<const ChildBall> balls) {
  std::vector<double> least(problem.points.size(), kInfinity), costs;
  std::vector<PointSet> reachPoints(problem.reach.size());
  for (const auto& [ball, parent] : balls) {
    const std::vector<std::uint32_t>& reach = problem.reach[parent];
    if (reachPoints[parent].empty()) reachPoints[parent].assign(problem.points, reach);
    costs.resize(reach.size());
    reachPoints[parent].distances(ball.center, ball.depth, costs);
    for (std::size_t slot = 0; slot < reach.size(); ++slot)
      least[reach[slot]] = std::min(least[reach[slot]], costs[slot]);
  }
  return *std::max_element(least.begin(), least.end());
}

std::vector<ChildBall> optimiseLevel(const LevelProblem& problem, std::vector<ChildBall> start) {
  LevelOptimisation optimisation(problem, std::move(start));
  optimisation.fillFamilies();
  optimisation.run();
  return optimisation.settled();
}

}  // namespace cairn::builder
