// SPDX-License-Identifier: GPL-3.0-or-later
#include "share_parts.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "surface/random_stream.h"

namespace cairn::builder {

namespace {

using ParentMask = std::uint32_t;

/// The parents of one family share; `ParentMask` has a bit for each.
constexpr int kMaxParents = 8;
constexpr int kSteps = 6000;
/// Longest and shortest step of a parent's centre, as fractions of the limit.
constexpr double kLongestStep = 0.6, kShortestStep = 0.02;
/// Factors by which the limit rises until all parts have room, and then falls while they have.
constexpr double kLoosening = 1.05, kTightening = 0.996;
/// Number of points examined of each part, the extreme ones first.
constexpr std::size_t kPointsPerPart = 40;

/// The places below the parents. Balls with a choice are placed by augmenting paths.
class Places {
 public:
  Places(std::size_t parents, std::size_t room) : room_(parents, room), parts_(parents) {}

  std::size_t roomOf(std::uint32_t parent) const { return room_[parent]; }
  const std::vector<std::uint32_t>& partsOf(std::uint32_t parent) const { return parts_[parent]; }
  /// Takes a place permanently. Precondition: there is room, and no part was placed yet.
  void take(std::uint32_t parent) { --room_[parent]; }
  /// Finds a place for a part below one of its choices, and moves other parts among their choices. False when there is
  /// none.
  bool place(std::uint32_t part, std::span<const ParentMask> choices) {
    seen_ = 0;
    return placeUnseen(part, choices);
  }

 private:
  bool placeUnseen(std::uint32_t part, std::span<const ParentMask> choices) {
    for (std::uint32_t k = 0; k < room_.size(); ++k) {
      if ((choices[part] & ~seen_ & 1U << k) == 0) continue;
      seen_ |= 1U << k;
      if (parts_[k].size() < room_[k]) {
        parts_[k].push_back(part);
        return true;
      }
      for (std::uint32_t& other : parts_[k])
        if (placeUnseen(other, choices)) {
          other = part;
          return true;
        }
    }
    return false;
  }

  std::vector<std::size_t> room_;
  std::vector<std::vector<std::uint32_t>> parts_;
  ParentMask seen_ = 0;
};

class Sharing {
 public:
  Sharing(std::span<const PointSet> parts, const DepthField& field, SphereSet parents, double limit,
          std::size_t branching)
      : field_(field), parents_(std::move(parents)), limit_(limit), branching_(branching) {
    for (const PointSet& part : parts) {
      begin_.push_back(points_.size());
      std::vector<Vec3d> list;
      for (std::size_t p = 0; p < part.size(); ++p) list.push_back(part[p]);
      if (list.empty()) continue;
      for (const Vec3d& p : farthestPointSample(list, kPointsPerPart, 0)) points_.push(p);
    }
    begin_.push_back(points_.size());
    costs_.resize(parents_.size() * points_.size());
    masks_.resize(points_.size(), 0);
    for (std::uint32_t k = 0; k < parents_.size(); ++k) measure(k, parents_[k]);
    see();
  }

  void loosen() {
    while (!hasRoom(nullptr)) {
      limit_ *= kLoosening;
      see();
    }
  }

  void tighten(RandomStream random, double lowest) {
    while (limit_ > lowest && lower()) {
    }
    for (int i = 0; i < kSteps && limit_ > lowest; ++i) {
      const auto any = static_cast<std::size_t>(random.uniform() * static_cast<double>(parents_.size()));
      const auto k = static_cast<std::uint32_t>(std::min(any, parents_.size() - 1));
      if (!move(k, step(k, random))) continue;
      while (limit_ > lowest && lower()) {
      }
    }
  }

  SharedParts result() const {
    SharedParts shared{parents_, limit_, std::vector<std::vector<std::uint32_t>>(begin_.size() - 1)};
    hasRoom(&shared.parentsOf);
    return shared;
  }

 private:
  Ball step(std::uint32_t k, RandomStream& random) const {
    static const double range = std::log(kLongestStep / kShortestStep);
    const double reach = limit_ * kLongestStep * std::exp(-range * random.uniform());
    const Vec3d center = random.inBall(parents_[k].center, reach);
    return {center, 0, field_.at(center, parents_[k].depth, distance(center, parents_[k].center)).depth};
  }

  bool move(std::uint32_t k, const Ball& moved) {
    saved_ = masks_;
    measure(k, moved);
    see(k);
    if (hasRoom(nullptr)) {
      parents_[k] = moved;
      return true;
    }
    masks_ = saved_;
    measure(k, parents_[k]);
    return false;
  }

  bool lower() {
    saved_ = masks_;
    const double before = limit_;
    limit_ *= kTightening;
    see();
    if (hasRoom(nullptr)) return true;
    limit_ = before;
    masks_ = saved_;
    return false;
  }

  std::span<double> row(std::uint32_t k) { return std::span(costs_).subspan(k * points_.size(), points_.size()); }
  void measure(std::uint32_t k, const Ball& ball) { points_.distances(ball.center, ball.depth, row(k)); }

  void see(std::uint32_t k) {
    const std::span<const double> costs = row(k);
    const ParentMask bit = 1U << k;
    for (std::size_t p = 0; p < masks_.size(); ++p) masks_[p] = costs[p] <= limit_ ? masks_[p] | bit : masks_[p] & ~bit;
  }
  void see() {
    for (std::uint32_t k = 0; k < parents_.size(); ++k) see(k);
  }

  /// True when all parts find places; `parentsOf`, if given, receives their parents.
  bool hasRoom(std::vector<std::vector<std::uint32_t>>* parentsOf) const {
    if (std::find(masks_.begin(), masks_.end(), 0U) != masks_.end()) return false;
    const std::size_t parts = begin_.size() - 1;
    Places places(parents_.size(), branching_);
    std::vector<ParentMask> holders(parts, 0);
    for (std::uint32_t i = 0; i < parts; ++i) {
      if (begin_[i] == begin_[i + 1]) continue;
      holders[i] = ~0U;
      for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p) holders[i] &= masks_[p];
      if (holders[i] == 0 && !split(i, places, parentsOf)) return false;
    }
    for (int choices = 1; choices <= kMaxParents;
         ++choices)  // parts with the fewest choices first: shorter augmenting paths
      for (std::uint32_t i = 0; i < parts; ++i)
        if (std::popcount(holders[i]) == choices && !places.place(i, holders)) return false;
    if (parentsOf)
      for (std::uint32_t k = 0; k < parents_.size(); ++k)
        for (const std::uint32_t i : places.partsOf(k)) (*parentsOf)[i].push_back(k);
    return true;
  }

  /// Takes a place below each of two parents that hold the part together: the two with the most room.
  bool split(std::uint32_t part, Places& places, std::vector<std::vector<std::uint32_t>>* parentsOf) const {
    std::size_t most = 0;
    std::uint32_t first = 0, second = 0;
    for (std::uint32_t k = 0; k < parents_.size(); ++k)
      for (std::uint32_t l = k + 1; l < parents_.size(); ++l) {
        const std::size_t room = std::min(places.roomOf(k), places.roomOf(l));
        if (room <= most || !holdBetween(part, 1U << k | 1U << l)) continue;
        most = room;
        first = k;
        second = l;
      }
    if (most == 0) return false;
    for (const std::uint32_t k : {first, second}) {
      places.take(k);
      if (parentsOf) (*parentsOf)[part].push_back(k);
    }
    return true;
  }

  bool holdBetween(std::uint32_t part, ParentMask pair) const {
    for (std::size_t p = begin_[part]; p < begin_[part + 1]; ++p)
      if ((masks_[p] & pair) == 0) return false;
    return true;
  }

  const DepthField& field_;
  SphereSet parents_;
  double limit_;
  std::size_t branching_;
  PointSet points_;                        // of all parts, one after the other
  std::vector<std::size_t> begin_;         // of each part's points
  std::vector<double> costs_;              // of parent k for point p at k * points + p
  std::vector<ParentMask> masks_, saved_;  // by point: the parents that hold it
};

}  // namespace

SharedParts shareParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, double lowest,
                       std::size_t branching, std::uint64_t seed) {
  assert(!start.empty() && start.size() <= kMaxParents && parts.size() <= start.size() * branching);
  for (Ball& parent : start) parent.depth = field.depth(parent.center);
  Sharing sharing(parts, field, std::move(start), lowest, branching);
  sharing.loosen();
  sharing.tighten({seed, 0}, lowest);
  return sharing.result();
}

}  // namespace cairn::builder
