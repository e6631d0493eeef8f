// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/relocate.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "cover/level_cover.h"
#include "surface/infinity.h"

namespace cairn::builder {
namespace {

/// What a step asks to save of the worst stand-off, and what it has to save to be kept.
constexpr double kRequest = 0.03, kWorthAStep = 0.002;
/// Balls optimised around the worst point, and around a ball that is taken away; once nothing helps, as many more.
constexpr std::size_t kAround = 5, kNeighbours = 4, kWider = 2;
/// Balls taken away in turn before a place is given up.
constexpr std::size_t kSwaps = 10;

using Names = std::vector<std::uint32_t>;

/// By point: its two cheapest balls and what they cost.
struct Holding {
  std::uint32_t ball = 0, second = 0;
  double cost = kInfinity, secondCost = kInfinity;
};

class Relocation {
 public:
  Relocation(const RelocationProblem& problem, SphereSet balls)
      : problem_(problem), balls_(std::move(balls)), attempts_(problem.attempts) {
    measure();
  }

  SphereSet run() {
    while (attempts_ > 0 && problem_.keepGoing()) {
      const std::uint32_t worst = worstPoint();
      if (holding_[worst].cost <= problem_.enough || !relieve(worst)) break;
    }
    return std::move(balls_);
  }

 private:
  void measure() {
    holding_.assign(problem_.points.size(), {});
    std::vector<double> costs(problem_.points.size());
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      problem_.points.distances(balls_[i].center, balls_[i].depth, costs);
      for (std::size_t p = 0; p < costs.size(); ++p) {
        Holding& h = holding_[p];
        if (costs[p] < h.cost) {
          h = {i, h.ball, costs[p], h.cost};
        } else if (costs[p] < h.secondCost) {
          h.second = i;
          h.secondCost = costs[p];
        }
      }
    }
  }

  std::uint32_t worstPoint() const {
    const auto costlier = [](const Holding& a, const Holding& b) { return a.cost < b.cost; };
    return static_cast<std::uint32_t>(std::max_element(holding_.begin(), holding_.end(), costlier) - holding_.begin());
  }

  /// The `count` balls that hold a point most cheaply, the cheapest first.
  Names cheapestFor(const Vec3d& point, std::size_t count) const {
    Names names(balls_.size());
    std::iota(names.begin(), names.end(), 0U);
    std::vector<double> costs;
    for (const Ball& ball : balls_) costs.push_back(costOf(ball, point));
    std::stable_sort(names.begin(), names.end(), [&](std::uint32_t a, std::uint32_t b) { return costs[a] < costs[b]; });
    names.resize(std::min(count, names.size()));
    return names;
  }

  /// Balls in order of what their points would cost the others at most.
  Names mostDispensableFirst() const {
    std::vector<double> price(balls_.size(), -kInfinity);
    for (const Holding& h : holding_) price[h.ball] = std::max(price[h.ball], h.secondCost);
    Names names(balls_.size());
    std::iota(names.begin(), names.end(), 0U);
    std::stable_sort(names.begin(), names.end(), [&](std::uint32_t a, std::uint32_t b) { return price[a] < price[b]; });
    return names;
  }

  /// The balls that would take over the points of ball `i`, those that would take most first.
  Names heirsOf(std::uint32_t i, std::size_t most) const {
    std::vector<std::size_t> shares(balls_.size(), 0);
    for (const Holding& h : holding_)
      if (h.ball == i && h.secondCost < kInfinity) ++shares[h.second];
    Names names(balls_.size());
    std::iota(names.begin(), names.end(), 0U);
    std::stable_sort(names.begin(), names.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return shares[a] > shares[b]; });
    std::size_t heirs = 0;
    while (heirs < std::min(most, names.size()) && shares[names[heirs]] > 0) ++heirs;
    names.resize(heirs);
    return names;
  }

  /// One step. False when nothing lowers the place's worst.
  bool relieve(std::uint32_t worst) {
    for (std::size_t wider = 1; wider <= kWider; ++wider) {
      const Names around = cheapestFor(problem_.points[worst], wider * kAround);
      if (better(worst, around, std::nullopt)) return true;
      const Names order = mostDispensableFirst();
      for (std::size_t n = 0; n < std::min(kSwaps, order.size()) && attempts_ > 0 && problem_.keepGoing(); ++n) {
        Names chosen = around;
        chosen.push_back(order[n]);
        for (const std::uint32_t heir : heirsOf(order[n], wider * kNeighbours)) chosen.push_back(heir);
        if (better(worst, chosen, order[n])) return true;
      }
    }
    return false;
  }

  /// The points these balls (ascending) hold and no other does within `goal`.
  PointSet dutiesOf(const Names& chosen, double goal) const {
    Names mine;
    for (std::uint32_t p = 0; p < holding_.size(); ++p)
      if (std::binary_search(chosen.begin(), chosen.end(), holding_[p].ball)) mine.push_back(p);
    PointSet points;
    points.assign(problem_.points, mine);
    std::vector<double> least(mine.size(), kInfinity), costs(mine.size());
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      if (std::binary_search(chosen.begin(), chosen.end(), i)) continue;
      points.distances(balls_[i].center, balls_[i].depth, costs);
      for (std::size_t k = 0; k < costs.size(); ++k) least[k] = std::min(least[k], costs[k]);
    }
    Names left;
    for (std::uint32_t k = 0; k < least.size(); ++k)
      if (least[k] > goal) left.push_back(k);
    PointSet duties;
    duties.assign(points, left);
    return duties;
  }

  /// One attempt: these balls optimised while all others stay, `removed` of them set down anew. Keeps it if that is
  /// worth a step.
  bool better(std::uint32_t worst, Names chosen, std::optional<std::uint32_t> removed) {
    --attempts_;
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    const double before = holding_[worst].cost, goal = std::max(problem_.enough, before * (1 - kRequest));
    const PointSet duties = dutiesOf(chosen, goal);
    const std::size_t spare = problem_.count - balls_.size();
    std::vector<ChildBall> start;
    for (const std::uint32_t i : chosen)
      if (i != removed) start.push_back({balls_[i], 0});
    Names every(duties.size());
    std::iota(every.begin(), every.end(), 0U);
    LevelProblem local{duties, problem_.field, std::span(&every, 1), chosen.size() + spare, goal};
    local.keepGoing = &problem_.keepGoing;
    const std::vector<ChildBall> found = optimiseLevel(local, std::move(start));
    if (!problem_.keepGoing() || coverStandOff(local, found) >= before * (1 - kWorthAStep)) return false;
    SphereSet kept;
    for (std::uint32_t i = 0; i < balls_.size(); ++i)
      if (!std::binary_search(chosen.begin(), chosen.end(), i)) kept.push_back(balls_[i]);
    for (const ChildBall& child : found) kept.push_back(child.ball);
    balls_ = std::move(kept);
    measure();
    return true;
  }

  const RelocationProblem& problem_;
  SphereSet balls_;
  std::size_t attempts_;
  std::vector<Holding> holding_;
};

}  // namespace

SphereSet relocate(const RelocationProblem& problem, SphereSet balls) {
  return Relocation(problem, std::move(balls)).run();
}

}  // namespace cairn::builder
