// SPDX-License-Identifier: GPL-3.0-or-later
#include "hubbard.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <tuple>

#include "spheres/point_set.h"
#include "spheres/ritter_ball.h"

namespace cairn::builder {

namespace {

using Indices = std::vector<std::uint32_t>;  // ascending

Indices unionOf(const Indices& a, const Indices& b) {
  Indices all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

struct Group {
  EnclosingBall ball;
  Indices samples, members;
  std::set<std::uint32_t> neighbours;  // groups, alive ones only
  bool alive = true;
};

class Merging {
 public:
  Merging(const HubbardMedial& medial, std::span<const std::uint32_t> members) : medial_(medial) {
    for (const std::uint32_t m : members) {
      const HubbardMedial::Sphere& sphere = medial.spheres[m];
      Group group{{sphere.ball.center, sphere.ball.radius}, {sphere.samples.begin(), sphere.samples.end()}, {m}, {}};
      for (const std::uint32_t n : sphere.neighbours) {
        const auto place = std::lower_bound(members.begin(), members.end(), n);
        if (place != members.end() && *place == n)
          group.neighbours.insert(static_cast<std::uint32_t>(place - members.begin()));
      }
      groups_.push_back(std::move(group));
    }
    alive_ = groups_.size();
    for (std::uint32_t i = 0; i < groups_.size(); ++i) {
      for (const std::uint32_t k : groups_[i].neighbours)
        if (i < k) propose(i, k);
      adopt(i);
    }
  }

  std::vector<Group> run(std::size_t count) {
    while (alive_ > count) {
      const auto [error, a, b] = pairs_.top();
      pairs_.pop();
      if (groups_[a].alive && groups_[b].alive) merge(a, b);
    }
    std::erase_if(groups_, [](const Group& g) { return !g.alive; });
    return std::move(groups_);
  }

 private:
  using Pair = std::tuple<double, std::uint32_t, std::uint32_t>;  // error, groups

  EnclosingBall ballAround(const Indices& samples) const {
    std::vector<Vec3d> points;
    for (const std::uint32_t s : samples) points.push_back(medial_.samples[s].point);
    return ritterBall(points);
  }

  double errorOf(const EnclosingBall& ball, const Indices& samples) const {
    double worst = 0;
    for (const std::uint32_t s : samples)
      for (const std::uint32_t cluster : medial_.samples[s].clusters)
        worst = std::max(
            worst, normalStandOff(ball.center, ball.radius, medial_.samples[s].point, medial_.clusterNormals[cluster]));
    return worst;
  }

  void propose(std::uint32_t a, std::uint32_t b) {
    const Indices samples = unionOf(groups_[a].samples, groups_[b].samples);
    pairs_.emplace(errorOf(ballAround(samples), samples), a, b);
  }

  /// Neighbours for a group that has none: those it overlaps, or else all.
  void adopt(std::uint32_t i) {
    if (!groups_[i].neighbours.empty()) return;
    for (const bool all : {false, true}) {
      for (std::uint32_t k = 0; k < groups_.size(); ++k) {
        if (k == i || !groups_[k].alive) continue;
        const double reach = groups_[i].ball.radius + groups_[k].ball.radius;
        if (!all && distance(groups_[i].ball.center, groups_[k].ball.center) > reach) continue;
        groups_[i].neighbours.insert(k);
        groups_[k].neighbours.insert(i);
        propose(std::min(i, k), std::max(i, k));
      }
      if (!groups_[i].neighbours.empty()) return;
    }
  }

  void merge(std::uint32_t a, std::uint32_t b) {
    const auto fresh = static_cast<std::uint32_t>(groups_.size());
    Group group{{},
                unionOf(groups_[a].samples, groups_[b].samples),
                unionOf(groups_[a].members, groups_[b].members),
                groups_[a].neighbours};
    group.ball = ballAround(group.samples);
    group.neighbours.insert(groups_[b].neighbours.begin(), groups_[b].neighbours.end());
    group.neighbours.erase(a);
    group.neighbours.erase(b);
    for (const std::uint32_t old : {a, b}) {
      for (const std::uint32_t n : groups_[old].neighbours) groups_[n].neighbours.erase(old);
      groups_[old] = {{}, {}, {}, {}, false};
    }
    --alive_;
    groups_.push_back(std::move(group));
    for (const std::uint32_t n : groups_[fresh].neighbours) {
      groups_[n].neighbours.insert(fresh);
      propose(n, fresh);
    }
    adopt(fresh);
  }

  const HubbardMedial& medial_;
  std::vector<Group> groups_;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> pairs_;
  std::size_t alive_ = 0;
};

}  // namespace

std::vector<Pieces> divideByOwners(const HubbardMedial& medial, std::span<const HubbardGroup> groups,
                                   std::span<const Piece> pieces) {
  assert(!groups.empty());
  std::vector<Vec3d> list;
  for (const Piece& piece : pieces) list.push_back(centroidOf(piece));
  const PointSet centroids(list);
  std::vector<double> distances(list.size()), nearest(list.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> owner(list.size(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::uint32_t m : groups[g].members) {
      centroids.distances(medial.spheres[m].ball.center, medial.spheres[m].ball.radius, distances);
      for (std::size_t p = 0; p < list.size(); ++p) {
        if (distances[p] >= nearest[p]) continue;
        nearest[p] = distances[p];
        owner[p] = g;
      }
    }
  std::vector<Pieces> parts(groups.size());
  for (std::size_t p = 0; p < list.size(); ++p) parts[owner[p]].push_back(pieces[p]);
  return parts;
}

double normalStandOff(const Vec3d& center, double radius, const Vec3d& point, const Vec3d& normal) {
  const double height = dot(center - point, normal);
  const double besideSq = lengthSq(center - point) - height * height;
  return std::sqrt(std::max(0.0, radius * radius - besideSq)) + height;
}

std::vector<HubbardGroup> mergeHubbard(const HubbardMedial& medial, std::span<const std::uint32_t> members,
                                       std::size_t count, const DepthField& solid) {
  assert(!members.empty() && count >= 1);
  std::vector<HubbardGroup> result;
  for (Group& group : Merging(medial, members).run(count))
    result.push_back(
        {{group.ball.center, group.ball.radius, solid.depth(group.ball.center)}, std::move(group.members)});
  return result;
}

}  // namespace cairn::builder
