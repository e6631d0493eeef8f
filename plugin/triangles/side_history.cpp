// SPDX-License-Identifier: Zlib
#include "triangles/side_history.h"

#include <algorithm>
#include <cmath>

namespace cairn::bullet {

namespace {

// Cosine of the 60 degrees within which two directions mean the same side of a node.
constexpr float kSameSideCosine = 0.5F;
// Cosine of the 25 degrees within which the rest of the tree is a witness for a triangle.
constexpr float kWitnessCosine = 0.906307787F;
// A plane lies before another if its point is farther along the other's normal than this fraction of their distance.
constexpr float kBeforeShare = 0.5F;
// Witnesses within 3 degrees (cosine) count as one, if their planes hold each other's point up to this fraction of the
// distance. The number kept bounds the work of a step.
constexpr float kAlikeCosine = 0.99863F;
constexpr float kAlikeShare = 0.05F;
constexpr std::size_t kMaxWitnesses = 64;
// Cosines of the 45 degrees within which directions vote alike, and of the 18 within which votes are counted together.
// The number of counts is bounded.
constexpr float kVoteCosine = 0.707106781F, kOneVoteCosine = 0.951056516F;
constexpr std::size_t kMaxVotes = 32;
constexpr std::uint32_t kOutvoted = 3;

bool liesBefore(const SurfaceSide& plane, const Vec3& point, float tolerance) {
  const Vec3 apart = point - plane.point;
  return dot(plane.normal, apart) > kBeforeShare * length(apart) + tolerance;
}

}  // namespace

void SideHistory::reset() {
  sides_.clear();
  notes_.clear();
  witnesses_.clear();
  votes_.clear();
  traversal_ = 0;
}

void SideHistory::beginTraversal() {
  std::erase_if(sides_, [&](const Side& s) { return s.seen != traversal_; });
  ++traversal_;
}

void SideHistory::count() {
  votes_.clear();
  for (const Side& side : sides_) {
    const auto same = std::find_if(votes_.begin(), votes_.end(), [&](const Votes& v) {
      return dot(v.direction, side.plane.normal) > kOneVoteCosine;
    });
    if (same != votes_.end())
      ++same->count;
    else if (votes_.size() < kMaxVotes)
      votes_.push_back({side.plane.normal, 1});
  }
}

bool SideHistory::isOutvoted(const Vec3& direction) const {
  std::uint32_t along = 0, against = 0;
  for (const Votes& v : votes_) {
    const float cosine = dot(v.direction, direction);
    if (cosine > kVoteCosine) along += v.count;
    if (cosine < -kVoteCosine) against += v.count;
  }
  return against > 0 && against >= kOutvoted * along;
}

int SideHistory::ofNode(NodeId node, const SurfaceSide& surface, float tolerance) const {
  const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), Side{node, {}, 0}, byNode);
  float along = kSameSideCosine, against = kSameSideCosine;
  for (auto side = first; side != last; ++side) {
    const float cosine = dot(side->plane.normal, surface.normal);
    along = std::max(along, cosine);
    if (-cosine > against && !liesBefore(side->plane, surface.point, tolerance)) against = -cosine;
  }
  if (along > kSameSideCosine && along >= against) return 1;
  return against > kSameSideCosine ? -1 : 0;
}

bool SideHistory::isBehind(NodeId node, const Vec3& point) const {
  const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), Side{node, {}, 0}, byNode);
  return std::any_of(first, last, [&](const Side& s) { return dot(s.plane.normal, point - s.plane.point) < 0; });
}

int SideHistory::ofTree(const SurfaceSide& surface, float tolerance) const {
  bool along = false, against = false;
  for (const SurfaceSide& plane : witnesses_) {
    const float cosine = dot(plane.normal, surface.normal);
    if (std::abs(cosine) < kWitnessCosine) continue;
    if (std::abs(dot(plane.normal, surface.point - plane.point)) > tolerance) continue;
    along = along || cosine > 0;
    against = against || cosine < 0;
  }
  return int(along) - int(against);
}

void SideHistory::note(NodeId node, const SurfaceSide& side) {
  notes_.push_back({node, side, traversal_});
}

void SideHistory::endNotes() {
  for (const Side& note : notes_) {
    hold(note);
    witness(note.plane);
  }
  notes_.clear();
}

void SideHistory::hold(const Side& note) {
  const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), note, byNode);
  const auto same = std::find_if(
      first, last, [&](const Side& s) { return dot(s.plane.normal, note.plane.normal) > kSameSideCosine; });
  if (same != last)
    *same = note;
  else
    sides_.insert(last, note);
}

void SideHistory::witness(const SurfaceSide& plane) {
  const auto isAlike = [&](const SurfaceSide& p) {
    const Vec3 apart = plane.point - p.point;
    return dot(p.normal, plane.normal) > kAlikeCosine && std::abs(dot(p.normal, apart)) <= kAlikeShare * length(apart);
  };
  if (witnesses_.size() < kMaxWitnesses && std::none_of(witnesses_.begin(), witnesses_.end(), isAlike))
    witnesses_.push_back(plane);
}

}  // namespace cairn::bullet
