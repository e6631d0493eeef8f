// SPDX-License-Identifier: GPL-3.0-or-later
#include "merge.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>

#include "spheres/enclosing_ball.h"

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
  std::size_t a = 0, b = 0;  // a < b
  Ball merged;

  friend bool operator==(const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }
  friend bool operator<(const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }
};

double farthestOf(const Vec3d& center, const Cluster& a, const Cluster& b) {
  double farthestSq = 0;
  for (const Vec3d& p : a.points) farthestSq = std::max(farthestSq, lengthSq(p - center));
  for (const Vec3d& p : b.points) farthestSq = std::max(farthestSq, lengthSq(p - center));
  return std::sqrt(farthestSq);
}

class Merging {
 public:
  Merging(const CoverProblem& problem, std::span<const Ball> candidates) : problem_(problem) {
    distribute(candidates);
    for (std::size_t i = 0; i < clusters_.size(); ++i)
      if (alive(i) && !hasPair(i)) adopt(i);
  }

  SphereSet run() {
    bool allPairs = false;
    while (alive_ > problem_.count) {
      if (!allPairs && static_cast<double>(alive_) <= kAllPairsBelow * static_cast<double>(problem_.count)) {
        allPairs = true;
        pairAll();
      }
      merge(nextPair());
    }
    SphereSet set;
    for (const Cluster& c : clusters_)
      if (c.alive) set.push_back(c.ball);
    return set;
  }

 private:
  bool alive(std::size_t i) const { return clusters_[i].alive; }
  bool hasPair(std::size_t i) const {
    return std::any_of(pairs_.begin(), pairs_.end(), [i](const Pair& p) { return p.a == i || p.b == i; });
  }

  /// Points to their cheapest candidates; candidates without points fall away.
  void distribute(std::span<const Ball> candidates) {
    const std::size_t n = problem_.points.size();
    std::vector<double> costs(n);
    std::vector<std::size_t> first(n, 0), second(n, 0);
    std::vector<double> firstCost(n, std::numeric_limits<double>::infinity()), secondCost = firstCost;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
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
    std::vector<Pair> touching;
    for (std::size_t p = 0; p < n; ++p)
      if (secondCost[p] < std::numeric_limits<double>::infinity() && alive(second[p]))
        touching.push_back({std::min(first[p], second[p]), std::max(first[p], second[p]), {}});
    std::sort(touching.begin(), touching.end());
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    for (const Pair& pair : touching) addPair(pair.a, pair.b);
  }

  void addPair(std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    pairs_.push_back({a, b, mergedBall(clusters_[a], clusters_[b])});
  }

  Ball mergedBall(const Cluster& a, const Cluster& b) const {
    std::vector<Vec3d> points = a.points;
    points.insert(points.end(), b.points.begin(), b.points.end());
    const EnclosingBall smallest = smallestEnclosingBall(points);
    Ball best;
    Ball known;  // the one whose depth says most about that of the smallest ball: none changes faster than its point
                 // moves
    double moved = std::numeric_limits<double>::infinity();
    for (const Cluster* old : {&a, &b}) {
      const Ball around{old->ball.center, farthestOf(old->ball.center, a, b), old->ball.depth};
      if (old == &a || around.standOff() < best.standOff()) best = around;
      const double way = distance(around.center, smallest.center);
      if (way < moved) known = around, moved = way;
    }
    if (smallest.radius - (known.depth + moved) > best.standOff() + kRoundingRoom * smallest.radius) return best;
    const Ball around{smallest.center, smallest.radius, problem_.solid.at(smallest.center, known.depth, moved).depth};
    return best.standOff() < around.standOff() ? best : around;
  }

  /// Artificial neighbours for a cluster that has none: those its ball overlaps, or else all.
  void adopt(std::size_t i) {
    bool found = false;
    for (const bool all : {false, true}) {
      for (std::size_t k = 0; k < clusters_.size(); ++k) {
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
    std::vector<Pair> known = pairs_;
    std::sort(known.begin(), known.end());
    for (std::size_t a = 0; a < clusters_.size(); ++a)
      for (std::size_t b = a + 1; b < clusters_.size(); ++b)
        if (alive(a) && alive(b) && !std::binary_search(known.begin(), known.end(), Pair{a, b, {}})) addPair(a, b);
  }

  /// The merge that improves the worst ball most, if any does; otherwise the one with the smallest stand-off.
  Pair nextPair() const {
    assert(!pairs_.empty());
    std::size_t worst = 0;
    double worstStandOff = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < clusters_.size(); ++i)
      if (alive(i) && clusters_[i].ball.standOff() > worstStandOff) {
        worst = i;
        worstStandOff = clusters_[i].ball.standOff();
      }
    const Pair* best = nullptr;
    const Pair* beneficial = nullptr;
    for (const Pair& pair : pairs_) {
      const double standOff = pair.merged.standOff();
      if (best == nullptr || standOff < best->merged.standOff()) best = &pair;
      if ((pair.a == worst || pair.b == worst) && standOff < worstStandOff &&
          (beneficial == nullptr || standOff < beneficial->merged.standOff()))
        beneficial = &pair;
    }
    return beneficial != nullptr ? *beneficial : *best;
  }

  void merge(const Pair& pair) {
    const std::size_t merged = clusters_.size();
    clusters_.push_back({clusters_[pair.a].points, pair.merged, true});
    Cluster& cluster = clusters_.back();
    cluster.points.insert(cluster.points.end(), clusters_[pair.b].points.begin(), clusters_[pair.b].points.end());
    clusters_[pair.a].alive = clusters_[pair.b].alive = false;
    --alive_;
    std::vector<std::size_t> neighbors;
    for (const Pair& p : pairs_) {
      if (p.a == pair.a || p.a == pair.b) neighbors.push_back(p.b);
      if (p.b == pair.a || p.b == pair.b) neighbors.push_back(p.a);
    }
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    std::erase_if(pairs_, [&](const Pair& p) { return !alive(p.a) || !alive(p.b); });
    for (const std::size_t k : neighbors)
      if (alive(k)) addPair(k, merged);
    if (alive_ > problem_.count && !hasPair(merged)) adopt(merged);
  }

  const CoverProblem& problem_;
  std::vector<Cluster> clusters_;
  std::vector<Pair> pairs_;
  std::size_t alive_ = 0;
};

}  // namespace

SphereSet merge(const CoverProblem& problem, std::span<const Ball> candidates) {
  assert(!candidates.empty() && !problem.points.empty());
  return Merging(problem, candidates).run();
}

}  // namespace cairn::builder
