// SPDX-License-Identifier: GPL-3.0-or-later
#include "merge.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "balls/enclosing_ball.h"

namespace cairn::builder {

namespace {

/// Below this multiple of the wanted count every pair may merge (5.3.1: "2 or 3 times").
constexpr double kAllPairsBelow = 2.5;

struct Cluster {
  std::vector<Vec3d> points;
  Ball ball;
  bool alive = true;
};

struct Pair {
  std::uint32_t a = 0, b = 0;  // a < b
  Ball merged;
};

/// A pair, ordered by the stand-off of its ball; the older pair first on a tie.
struct QueuedPair {
  double standOff = 0;
  std::uint32_t index = 0;

  friend bool operator>(const QueuedPair& p, const QueuedPair& q) {
    return p.standOff != q.standOff ? p.standOff > q.standOff : p.index > q.index;
  }
};

/// Radius of the ball around the centre of `a` that holds the points of both.
double radiusAround(const Cluster& a, const Cluster& b) {
  double farthestSq = 0;
  for (const Vec3d& p : b.points) farthestSq = std::max(farthestSq, lengthSq(p - a.ball.center));
  return std::max(a.ball.radius, std::sqrt(farthestSq));
}

class Merging {
 public:
  Merging(const CoverProblem& problem, std::span<const Ball> candidates) : problem_(problem) {
    distribute(candidates);
    for (std::uint32_t i = 0; i < clusters_.size(); ++i)
      if (alive(i) && pairsOf_[i].empty()) adopt(i);
  }

  SphereSet run() {
    bool allPairs = false;
    while (alive_ > problem_.count) {
      if (!allPairs && static_cast<double>(alive_) <= kAllPairsBelow * static_cast<double>(problem_.count)) {
        allPairs = true;
        pairAll();
      }
      merge(pairs_[nextPair()]);
    }
    SphereSet set;
    for (const Cluster& c : clusters_)
      if (c.alive) set.push_back(c.ball);
    return set;
  }

 private:
  bool alive(std::size_t i) const { return clusters_[i].alive; }
  bool alive(const Pair& pair) const { return alive(pair.a) && alive(pair.b); }
  std::uint32_t partner(std::uint32_t pair, std::uint32_t i) const {
    return pairs_[pair].a == i ? pairs_[pair].b : pairs_[pair].a;
  }

  /// Assigns points to their cheapest candidates; candidates without points are dropped.
  void distribute(std::span<const Ball> candidates) {
    const std::size_t n = problem_.points.size();
    std::vector<double> costs(n);
    std::vector<std::uint32_t> first(n, 0), second(n, 0);
    std::vector<double> firstCost(n, std::numeric_limits<double>::infinity()), secondCost = firstCost;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
      problem_.points.distances(candidates[i].center, candidates[i].depth, costs);
      for (std::size_t p = 0; p < n; ++p) {
        if (costs[p] < firstCost[p]) {
          second[p] = first[p];
          secondCost[p] = firstCost[p];
          first[p] = i;
          firstCost[p] = costs[p];
        } else if (costs[p] < secondCost[p]) {
          second[p] = i;
          secondCost[p] = costs[p];
        }
      }
    }
    clusters_.resize(candidates.size());
    for (std::size_t p = 0; p < n; ++p) clusters_[first[p]].points.push_back(problem_.points[p]);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      Cluster& c = clusters_[i];
      c.alive = !c.points.empty();
      alive_ += c.alive ? 1 : 0;
      c.ball = {candidates[i].center, 0, candidates[i].depth};
      for (const Vec3d& p : c.points) c.ball.radius = std::max(c.ball.radius, distance(p, c.ball.center));
    }
    pairsOf_.resize(clusters_.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;
    for (std::size_t p = 0; p < n; ++p)
      if (secondCost[p] < std::numeric_limits<double>::infinity() && alive(second[p]))
        touching.push_back(std::minmax(first[p], second[p]));
    std::sort(touching.begin(), touching.end());
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    for (const auto& [a, b] : touching) addPair(a, b);
  }

  void addPair(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto index = static_cast<std::uint32_t>(pairs_.size());
    pairs_.push_back({a, b, mergedBall(clusters_[a], clusters_[b])});
    pairsOf_[a].push_back(index);
    pairsOf_[b].push_back(index);
    queue_.push({pairs_.back().merged.standOff(), index});
  }

  Ball mergedBall(const Cluster& a, const Cluster& b) {
    Ball best;
    for (const Cluster* old : {&a, &b}) {
      const Ball around{old->ball.center, radiusAround(*old, old == &a ? b : a), old->ball.depth};
      if (old == &a || around.standOff() < best.standOff()) best = around;
    }
    both_.assign(a.points.begin(), a.points.end());
    both_.insert(both_.end(), b.points.begin(), b.points.end());
    const EnclosingBall smallest = search_.around(both_);
    double nearestSq = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : both_) nearestSq = std::min(nearestSq, lengthSq(p - smallest.center));
    // Points lie on the surface, so the centre is no deeper than this.
    const double nearest = std::sqrt(nearestSq);
    if (smallest.radius - nearest > best.standOff() + kRoundingRoom * smallest.radius) return best;
    const Ball around{smallest.center, smallest.radius, problem_.solid.at(smallest.center, 0, nearest).depth};
    return best.standOff() < around.standOff() ? best : around;
  }

  /// Artificial neighbours for a cluster that has none: those its ball overlaps, or else all.
  void adopt(std::uint32_t i) {
    bool found = false;
    for (const bool all : {false, true}) {
      for (std::uint32_t k = 0; k < clusters_.size(); ++k) {
        if (k == i || !alive(k)) continue;
        const double reach = clusters_[i].ball.radius + clusters_[k].ball.radius;
        if (!all && distance(clusters_[i].ball.center, clusters_[k].ball.center) > reach) continue;
        addPair(i, k);
        found = true;
      }
      if (found) return;
    }
  }

  void pairAll() {
    std::vector<char> known(clusters_.size());
    for (std::uint32_t a = 0; a < clusters_.size(); ++a) {
      if (!alive(a)) continue;
      std::fill(known.begin(), known.end(), 0);
      for (const std::uint32_t pair : pairsOf_[a]) known[partner(pair, a)] = 1;
      for (std::uint32_t b = a + 1; b < clusters_.size(); ++b)
        if (alive(b) && known[b] == 0) addPair(a, b);
    }
  }

  /// The merge that improves the worst ball most, if any does; otherwise the one with the smallest stand-off.
  std::uint32_t nextPair() {
    std::uint32_t worst = 0;
    double least = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < clusters_.size(); ++i)
      if (alive(i) && clusters_[i].ball.standOff() > least) {
        worst = i;
        least = clusters_[i].ball.standOff();
      }
    while (!alive(pairs_[queue_.top().index])) queue_.pop();  // a pair always exists: see `adopt`
    std::uint32_t best = queue_.top().index;
    for (const std::uint32_t pair : pairsOf_[worst])
      if (alive(pairs_[pair]) && pairs_[pair].merged.standOff() < least) {
        best = pair;
        least = pairs_[pair].merged.standOff();
      }
    return best;
  }

  void merge(const Pair pair) {
    const auto merged = static_cast<std::uint32_t>(clusters_.size());
    std::vector<std::uint32_t> neighbors;
    for (const std::uint32_t old : {pair.a, pair.b})
      for (const std::uint32_t p : pairsOf_[old])
        if (alive(pairs_[p])) neighbors.push_back(partner(p, old));
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    Cluster cluster{std::move(clusters_[pair.a].points), pair.merged, true};
    cluster.points.insert(cluster.points.end(), clusters_[pair.b].points.begin(), clusters_[pair.b].points.end());
    clusters_.push_back(std::move(cluster));
    pairsOf_.emplace_back();
    clusters_[pair.a].alive = clusters_[pair.b].alive = false;
    --alive_;
    for (const std::uint32_t k : neighbors)
      if (alive(k)) addPair(k, merged);
    if (alive_ > problem_.count && pairsOf_[merged].empty()) adopt(merged);
  }

  const CoverProblem& problem_;
  std::vector<Cluster> clusters_;
  std::vector<Pair> pairs_;                          // of the dead too
  std::vector<std::vector<std::uint32_t>> pairsOf_;  // by cluster
  std::priority_queue<QueuedPair, std::vector<QueuedPair>, std::greater<>> queue_;
  std::size_t alive_ = 0;
  std::vector<Vec3d> both_;  // the points of two clusters
  EnclosingBallSearch search_;
};

}  // namespace

SphereSet merge(const CoverProblem& problem, std::span<const Ball> candidates) {
  assert(!candidates.empty() && !problem.points.empty());
  return Merging(problem, candidates).run();
}

}  // namespace cairn::builder
