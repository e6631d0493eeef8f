// SPDX-License-Identifier: Zlib
#include "counterparts/touched_sides.h"

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

namespace {

// Cosine of the 60 degrees within which two directions are the same side of a node.
constexpr float kSameSideCosine = 0.5F;
// Cosine of the 25 degrees within which the rest of the tree says something about a triangle.
constexpr float kEvidenceCosine = 0.906307787F;
// Cosine of the half degree within which planes are one, and how many are kept: they bound the work of a step.
constexpr float kAlikeCosine = 0.99996F;
constexpr std::size_t kMaxPlanes = 64;

}  // namespace

void TouchedSides::reset() {
  sides_.clear();
  notes_.clear();
  notedPoints_.clear();
  planes_.clear();
  traversal_ = 0;
}

void TouchedSides::beginTraversal() {
  std::erase_if(sides_, [&](const Side& s) { return s.seen != traversal_; });
  ++traversal_;
}

int TouchedSides::ofNode(NodeId node, const Vec3& normal) const {
  const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), Side{node, {}, 0}, byNode);
  float best = 0;
  for (auto side = first; side != last; ++side) {
    const float cosine = dot(side->direction, normal);
    if (std::abs(cosine) > std::abs(best)) best = cosine;
  }
  return best > kSameSideCosine ? 1 : best < -kSameSideCosine ? -1 : 0;
}

int TouchedSides::ofTree(const Vec3& normal, const Vec3& point, float tolerance) const {
  bool along = false, against = false;
  for (const Plane& plane : planes_) {
    const float cosine = dot(plane.normal, normal);
    if (std::abs(cosine) < kEvidenceCosine || std::abs(dot(plane.normal, point - plane.point)) > tolerance) continue;
    along = along || cosine > 0;
    against = against || cosine < 0;
  }
  return int(along) - int(against);
}

void TouchedSides::note(NodeId node, const Vec3& direction, const Vec3& point) {
  notes_.push_back({node, direction, traversal_});
  notedPoints_.push_back(point);
}

void TouchedSides::endNotes() {
  for (std::size_t i = 0; i < notes_.size(); ++i) {
    hold(notes_[i]);
    hold(Plane{notes_[i].direction, notedPoints_[i]});
  }
  notes_.clear();
  notedPoints_.clear();
}

void TouchedSides::hold(const Side& note) {
  const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), note, byNode);
  const auto same =
      std::find_if(first, last, [&](const Side& s) { return dot(s.direction, note.direction) > kSameSideCosine; });
  if (same != last)
    *same = note;
  else
    sides_.insert(last, note);
}

void TouchedSides::hold(const Plane& plane) {
  const auto isAlike = [&](const Plane& p) {
    return dot(p.normal, plane.normal) > kAlikeCosine && dot(p.normal, plane.point - p.point) == 0;
  };
  if (planes_.size() < kMaxPlanes && std::none_of(planes_.begin(), planes_.end(), isAlike)) planes_.push_back(plane);
}

}  // namespace cairn::bullet
