// SPDX-License-Identifier: GPL-3.0-or-later
#include "hubbard.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "balls/nearest_ball.h"
#include "spheres/hubbard_error.h"
#include "surface/infinity.h"

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
  SampleSet samples;
  Indices members;
  std::set<std::uint32_t> neighbours;  // groups, alive ones only
  bool alive = true;
};

class HubbardMerging {
 public:
  HubbardMerging(const HubbardMedial& medial, std::span<const std::uint32_t> members, const KeepGoing& keepGoing)
      : errors_(medial), keepGoing_(keepGoing) {
    for (const std::uint32_t m : members) {
      const HubbardMedial::Sphere& sphere = medial.spheres[m];
      Group group{{sphere.ball.center, sphere.ball.radius}, SampleSet(sphere.samples, medial), {m}, {}};
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

  /// Empty when cancelled.
  std::vector<Group> run(std::size_t count) {
    constexpr std::size_t kPollEvery = 256;
    while (alive_ > count) {
      const Pair pair = pairs_.top();
      pairs_.pop();
      if (!groups_[pair.a].alive || !groups_[pair.b].alive) continue;
      if (!pair.exact) {
        pairs_.push({exactError(pair.a, pair.b), pair.a, pair.b, true});
        continue;
      }
      merge(pair.a, pair.b);
      if (alive_ % kPollEvery == 0 && !keepGoing_()) return {};
    }
    std::erase_if(groups_, [](const Group& g) { return !g.alive; });
    return std::move(groups_);
  }

 private:
  /// Two groups and the error of their merge, or a lower bound until it is exact. Most pairs are never needed before
  /// one of their groups merges elsewhere, so they cost only a bound.
  struct Pair {
    double error;
    std::uint32_t a, b;
    bool exact;

    friend bool operator<(const Pair& p, const Pair& q) {
      return std::tie(p.error, p.a, p.b) > std::tie(q.error, q.a, q.b);  // the least on top of the heap
    }
  };

  double exactError(std::uint32_t a, std::uint32_t b) const {
    const SampleSet samples(groups_[a].samples, groups_[b].samples);
    return errors_.of(samples.ritterBall(), samples);
  }

  /// Each of `others` with `fresh`.
  void proposeAll(const Indices& others, std::uint32_t fresh) {
    std::vector<double> errors(others.size());
    const auto bound = [&](std::size_t i) {
      errors[i] = errors_.atLeast(groups_[others[i]].samples, groups_[fresh].samples);
    };
    constexpr std::size_t kWorthATask = 20000;  // points examined: some 20 us of work
    if (others.size() * groups_[fresh].samples.size() < kWorthATask)
      for (std::size_t i = 0; i < others.size(); ++i) bound(i);
    else
      tbb::parallel_for(std::size_t{0}, others.size(), bound);
    for (std::size_t i = 0; i < others.size(); ++i) pairs_.push({errors[i], others[i], fresh, false});
  }

  void propose(std::uint32_t a, std::uint32_t b) {
    pairs_.push({errors_.atLeast(groups_[a].samples, groups_[b].samples), a, b, false});
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
                SampleSet(groups_[a].samples, groups_[b].samples),
                unionOf(groups_[a].members, groups_[b].members),
                groups_[a].neighbours};
    group.ball = group.samples.ritterBall();
    errors_.markWorst(group.ball, group.samples);
    group.neighbours.insert(groups_[b].neighbours.begin(), groups_[b].neighbours.end());
    group.neighbours.erase(a);
    group.neighbours.erase(b);
    for (const std::uint32_t old : {a, b}) {
      for (const std::uint32_t n : groups_[old].neighbours) groups_[n].neighbours.erase(old);
      groups_[old] = {{}, {}, {}, {}, false};
    }
    --alive_;
    groups_.push_back(std::move(group));
    const Indices neighbours(groups_[fresh].neighbours.begin(), groups_[fresh].neighbours.end());
    for (const std::uint32_t n : neighbours) groups_[n].neighbours.insert(fresh);
    proposeAll(neighbours, fresh);
    adopt(fresh);
  }

  HubbardError errors_;
  const KeepGoing& keepGoing_;
  std::vector<Group> groups_;
  std::priority_queue<Pair> pairs_;
  std::size_t alive_ = 0;
};

/// Assigns pieces to groups.
class Owners {
 public:
  Owners(const HubbardMedial& medial, std::span<const HubbardGroup> groups) : medial_(medial), groups_(groups) {
    std::vector<EnclosingBall> balls;
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::uint32_t m : groups[g].members) {
        balls.push_back({medial.spheres[m].ball.center, medial.spheres[m].ball.radius});
        groupOf_.push_back(g);
      }
    nearest_.emplace(std::move(balls));
  }

  std::size_t of(const Piece& piece) const {
    const std::size_t nearest = groupOf_[nearest_->to(centroidOf(piece))];
    double least = growthOf(nearest, piece);
    if (least <= 0) return nearest;
    std::size_t owner = nearest;
    const double near = gapOf(nearest, piece);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const double growth = growthOf(g, piece);
      if (growth >= least) continue;
      const double excess = std::max(growth, gapOf(g, piece) - near);
      if (excess >= least) continue;
      least = excess;
      owner = g;
    }
    return owner;
  }

 private:
  /// The length by which the group's merged ball has to grow to hold the piece.
  double growthOf(std::size_t group, const Piece& piece) const {
    const Ball& ball = groups_[group].ball;
    double reach = 0;
    for (const Vec3d& corner : piece.corners) reach = std::max(reach, distance(corner, ball.center));
    return reach - ball.radius;
  }

  /// The distance from the piece's centroid to the group's nearest medial sphere.
  double gapOf(std::size_t group, const Piece& piece) const {
    const Vec3d centroid = centroidOf(piece);
    double least = kInfinity;
    for (const std::uint32_t m : groups_[group].members) {
      const Ball& ball = medial_.spheres[m].ball;
      least = std::min(least, distance(centroid, ball.center) - ball.radius);
    }
    return least;
  }

  const HubbardMedial& medial_;
  std::span<const HubbardGroup> groups_;
  std::vector<std::size_t> groupOf_;  // by medial sphere of `nearest_`
  std::optional<NearestBall> nearest_;
};

}  // namespace

std::vector<Pieces> divideByOwners(const HubbardMedial& medial, std::span<const HubbardGroup> groups,
                                   std::span<const Piece> pieces) {
  assert(!groups.empty());
  const Owners owners(medial, groups);
  std::vector<std::size_t> owner(pieces.size());
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces.size(), kGrain), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) owner[p] = owners.of(pieces[p]);
  });
  std::vector<Pieces> parts(groups.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) parts[owner[p]].push_back(pieces[p]);
  return parts;
}

std::vector<HubbardGroup> mergeHubbard(const HubbardMedial& medial, std::span<const std::uint32_t> members,
                                       std::size_t count, const DepthField& solid, const KeepGoing& keepGoing) {
  assert(!members.empty() && count >= 1);
  std::vector<HubbardGroup> result;
  for (Group& group : HubbardMerging(medial, members, keepGoing).run(count))
    result.push_back(
        {{group.ball.center, group.ball.radius, solid.depth(group.ball.center)}, std::move(group.members)});
  return result;
}

}  // namespace cairn::builder
