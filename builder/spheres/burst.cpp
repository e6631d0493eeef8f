// SPDX-License-Identifier: GPL-3.0-or-later
#include "burst.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "balls/enclosing_ball.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

constexpr std::uint32_t kNone = ~0U;

using Indices = std::vector<std::uint32_t>;  // sorted

struct Member {
  Ball ball;
  Indices points;
  bool alive = true;
};

/// One ball's share of a removed ball's points.
struct Share {
  std::uint32_t heir = 0;
  Indices points;  // new to the heir
  Ball grown;      // the heir with them

  bool sameAs(const Share& other) const { return heir == other.heir && points == other.points; }
};

/// The effect of the removal of one ball.
struct Removal {
  std::vector<Share> shares;     // sorted by heir
  double before = 0, after = 0;  // worst stand-off of the balls involved
  bool known = false;
};

/// The two balls closest to covering a point (Eq. 5.2), so that either may be removed.
struct Closest {
  std::uint32_t first = kNone, second = kNone;
};

class Bursting {
 public:
  Bursting(const CoverProblem& problem, std::span<const Ball> candidates)
      : problem_(problem), points_(problem.points.size()), distances_(candidates.size() * points_) {
    for (const Ball& ball : candidates) members_.push_back({ball, {}});
    for (std::uint32_t i = 0; i < members_.size(); ++i) measure(i);
    closest_.resize(points_);
    for (std::uint32_t p = 0; p < points_; ++p) updateClosest(p);
    distribute();
    removals_.resize(members_.size());
    alive_ = static_cast<std::size_t>(
        std::count_if(members_.begin(), members_.end(), [](const Member& m) { return m.alive; }));
  }

  SphereSet run() {
    while (alive_ > problem_.count) {
      for (std::uint32_t i = 0; i < members_.size(); ++i)
        if (members_[i].alive) evaluate(i);
      remove(next());
    }
    SphereSet set;
    for (const Member& m : members_)
      if (m.alive) set.push_back(m.ball);
    return set;
  }

 private:
  double distanceTo(std::uint32_t member, std::uint32_t point) const { return distances_[member * points_ + point]; }

  void measure(std::uint32_t i) {
    problem_.points.distances(members_[i].ball.center, members_[i].ball.radius,
                              std::span(distances_).subspan(i * points_, points_));
  }

  void updateClosest(std::uint32_t p) {
    Closest c;
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      if (!members_[i].alive) continue;
      if (c.first == kNone || distanceTo(i, p) < distanceTo(c.first, p)) {
        c.second = std::exchange(c.first, i);
      } else if (c.second == kNone || distanceTo(i, p) < distanceTo(c.second, p)) {
        c.second = i;
      }
    }
    closest_[p] = c;
  }

  /// Every ball owns the points it holds. The closest ball owns points that none holds.
  void distribute() {
    for (std::uint32_t p = 0; p < points_; ++p)
      for (std::uint32_t i = 0; i < members_.size(); ++i)
        if (distanceTo(i, p) <= 0 || i == closest_[p].first) members_[i].points.push_back(p);
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      Member& m = members_[i];
      m.alive = !m.points.empty();
      if (!m.alive) continue;
      m.ball = enclosing(i, m.points);
      measure(i);
    }
    for (std::uint32_t p = 0; p < points_; ++p) updateClosest(p);
  }

  /// The tighter of the smallest ball around the points and the member's centre with the radius needed (5.3.2).
  Ball enclosing(std::uint32_t member, const Indices& points) const {
    std::vector<Vec3d> list;
    for (const std::uint32_t p : points) list.push_back(problem_.points[p]);
    const EnclosingBall smallest = smallestEnclosingBall(list);
    const Ball fresh{smallest.center, smallest.radius, problem_.solid.depth(smallest.center)};
    Ball kept{members_[member].ball.center, 0, members_[member].ball.depth};
    for (const Vec3d& p : list) kept.radius = std::max(kept.radius, distance(p, kept.center));
    return fresh.standOff() < kept.standOff() ? fresh : kept;
  }

  /// The balls that would take over the points of ball `i`.
  std::vector<Share> sharesOf(std::uint32_t i) const {
    std::vector<Share> shares;
    for (const std::uint32_t p : members_[i].points) {
      const std::uint32_t heir = closest_[p].first == i ? closest_[p].second : closest_[p].first;
      const Indices& known = members_[heir].points;
      if (std::binary_search(known.begin(), known.end(), p)) continue;
      auto place = std::lower_bound(shares.begin(), shares.end(), heir,
                                    [](const Share& s, std::uint32_t wanted) { return s.heir < wanted; });
      if (place == shares.end() || place->heir != heir) place = shares.insert(place, {heir, {}, {}});
      place->points.push_back(p);
    }
    return shares;
  }

  void evaluate(std::uint32_t i) {
    std::vector<Share> shares = sharesOf(i);
    Removal& removal = removals_[i];
    const auto& old = removal.shares;
    if (removal.known && std::equal(shares.begin(), shares.end(), old.begin(), old.end(),
                                    [](const Share& a, const Share& b) { return a.sameAs(b); }))
      return;
    removal = {std::move(shares), members_[i].ball.standOff(), -kInfinity, true};
    for (Share& share : removal.shares) {
      share.grown = enclosing(share.heir, merged(members_[share.heir].points, share.points));
      removal.before = std::max(removal.before, members_[share.heir].ball.standOff());
      removal.after = std::max(removal.after, share.grown.standOff());
    }
  }

  static Indices merged(const Indices& a, const Indices& b) {
    Indices all;
    std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
    return all;
  }

  std::uint32_t next() const {
    std::uint32_t least = kNone, gain = kNone;
    const auto saved = [&](std::uint32_t i) { return removals_[i].before - removals_[i].after; };
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      if (!members_[i].alive) continue;
      if (least == kNone || removals_[i].after < removals_[least].after) least = i;
      if (saved(i) > 0 && (gain == kNone || saved(i) > saved(gain))) gain = i;
    }
    return gain != kNone ? gain : least;
  }

  void remove(std::uint32_t gone) {
    members_[gone].alive = false;
    --alive_;
    std::vector<bool> changed(members_.size(), false);
    changed[gone] = true;
    for (const Share& share : removals_[gone].shares) {
      Member& heir = members_[share.heir];
      heir.points = merged(heir.points, share.points);
      heir.ball = share.grown;
      measure(share.heir);
      changed[share.heir] = true;
    }
    removals_[gone] = {};
    refresh(changed);
  }

  /// Distances to changed balls may have grown or shrunk. So every point is examined for which such a ball is, or
  /// becomes, one of the two closest.
  void refresh(const std::vector<bool>& changed) {
    for (std::uint32_t p = 0; p < points_; ++p) {
      const Closest& c = closest_[p];
      bool stale = changed[c.first] || c.second == kNone || changed[c.second];
      for (std::uint32_t i = 0; i < changed.size() && !stale; ++i)
        stale = changed[i] && members_[i].alive && distanceTo(i, p) <= distanceTo(c.second, p);
      if (stale) updateClosest(p);
    }
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      const auto& shares = removals_[i].shares;
      if (changed[i] || std::any_of(shares.begin(), shares.end(), [&](const Share& s) { return changed[s.heir]; }))
        removals_[i].known = false;
    }
  }

  const CoverProblem& problem_;
  std::size_t points_;
  std::vector<Member> members_;
  std::vector<double> distances_;  // of point p from the surface of ball i at i * points_ + p (Eq. 5.2)
  std::vector<Closest> closest_;
  std::vector<Removal> removals_;
  std::size_t alive_ = 0;
};

}  // namespace

SphereSet burst(const CoverProblem& problem, std::span<const Ball> candidates) {
  assert(!candidates.empty() && !problem.points.empty());
  return Bursting(problem, candidates).run();
}

}  // namespace cairn::builder
