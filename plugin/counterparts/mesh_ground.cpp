// SPDX-License-Identifier: Zlib
#include "counterparts/mesh_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/bullet/sphere_tree_shape.h"
#include "counterparts/feature_ids.h"
#include "kernel/contact_tuning.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// So many of the body's vertices say on which side it is, at most.
constexpr std::size_t kAsked = 24;
// And from step to step it moves no farther than this, of its size, if it is to be where it was.
constexpr double kMostWatched = 0.5;

// On which side of the nearest triangle a point is. Of those that meet where it is nearest, the one that it is most
// clearly on a side of says so; 0 where none does.
int sideOf(std::span<const Triangle> triangles, const Vec3& point) {
  constexpr float kSamePlace = 1 + 1e-4F;
  float nearest = std::numeric_limits<float>::infinity();
  for (const Triangle& t : triangles) nearest = std::min(nearest, lengthSq(point - nearestOnTriangle(t, point).point));
  float clearest = 0;
  for (const Triangle& t : triangles) {
    const Vec3 way = point - nearestOnTriangle(t, point).point;
    if (lengthSq(way) > nearest * kSamePlace) continue;
    const float height = dot(t.normal(), way);
    if (std::abs(height) > std::abs(clearest)) clearest = height;
  }
  return (clearest > 0) - (clearest < 0);
}

std::size_t nearestOf(std::span<const Triangle> triangles, const Vec3& point) {
  const auto distanceSq = [&](const Triangle& t) { return lengthSq(point - nearestOnTriangle(t, point).point); };
  return static_cast<std::size_t>(std::ranges::min_element(triangles, {}, distanceSq) - triangles.begin());
}

}  // namespace

void MeshGround::reset() {
  surface_.reset();
  hasGivenUp_ = isReversed_ = false;
  pieces_.clear();
  memory_.forget();
}

std::optional<float> MeshGround::append(const MeshQuestion& question, const PairPlacement& placement, const Near& near,
                                        std::vector<Contact>& contacts) {
  const PlacedTree& tree = placement.tree;
  const SurfaceView ground = surface_->view(isReversed_);
  const btTransform place = placement.other * btTransform(btQuaternion::getIdentity(), surface_->origin());
  const SurfacePair surfaces = SurfacePair::of(tree.tree().surfaceView(), tree.pose(), ground,
                                               Pose{toMat3d(place.getBasis()), toVec3d(place.getOrigin()), 1});
  const float contactDistance = placement.ownReach > 0 ? placement.ownReach : placement.reach;
  const float size = contactDistance / tuning::kContactDistance;
  const float thinner = std::min(tree.tree().surface().thickness * tree.scale(), ground.derived->thickness);
  const ContactLimits limits{contactDistance,
                             placement.reach,
                             std::min(tuning::kTrustedDepth * size, tuning::kTrustedThickness * thinner),
                             placement.treeMargin,
                             0,
                             size};
  const std::optional<ContactKernel::Answer> answer =
      question.kernel.run(surfaces, limits, memory_, question.placement, question.budget);
  if (!answer) return {};
  for (const FeatureContact& found : answer->contacts) contacts.push_back(contactOf(found, idOf(near, found)));
  return answer->apart;
}

// What has come far since was elsewhere meanwhile.
bool MeshGround::watch(const RelativePlacement& now, const PairPlacement& placement, const Near& near) {
  const bool isElsewhere = now.displacementSince(watchedAt_) > kMostWatched * double(placement.treeShape->size());
  watchedAt_ = now;
  if (isElsewhere) pieces_.clear();
  if (!follow(near)) {
    pieces_.clear();
    return false;
  }
  takeSides(placement, near);
  const bool isBehind = pieces_.front().isBehind;
  if (std::ranges::any_of(pieces_, [&](const Piece& piece) { return piece.isBehind != isBehind; })) return false;
  if (isBehind != isReversed_) memory_.forget();
  isReversed_ = isBehind;
  return true;
}

// Whether all that is near still is as it was, and bounds a solid.
bool MeshGround::follow(const Near& near) {
  if (hasGivenUp_ || near.soup.triangles().empty()) return false;
  if (!surface_) surface_ = GroundSurface::of(near.shape);
  if (!surface_) return false;
  nearTriangles_.clear();
  for (const TriangleSoup::Source& source : near.soup.triangles()) {
    nearTriangles_.push_back(surface_->triangleOf(source));
    if (nearTriangles_.back() == GroundSurface::kNone) {
      reset();
      hasGivenUp_ = true;
      return false;
    }
    if (!surface_->isClosed(surface_->pieceOf(nearTriangles_.back()))) return false;
  }
  return true;
}

// Of each piece that is near: the side that was taken when it came near.
void MeshGround::takeSides(const PairPlacement& placement, const Near& near) {
  lastPieces_.swap(pieces_);
  pieces_.clear();
  for (const std::uint32_t triangle : nearTriangles_) {
    const std::uint32_t index = surface_->pieceOf(triangle);
    const auto isIt = [&](const Piece& piece) { return piece.index == index; };
    if (std::ranges::any_of(pieces_, isIt)) continue;
    const auto last = std::ranges::find_if(lastPieces_, isIt);
    pieces_.push_back(last != lastPieces_.end() ? *last : Piece{index, isBehind(placement, near, index)});
  }
}

bool MeshGround::isBehind(const PairPlacement& placement, const Near& near, std::uint32_t piece) {
  asked_.clear();
  for (std::size_t i = 0; i < nearTriangles_.size(); ++i)
    if (surface_->pieceOf(nearTriangles_[i]) == piece) asked_.push_back(near.inPair[i]);
  const std::span<const Vec3> vertices = placement.tree.tree().vertices();
  const std::size_t stride = (vertices.size() + kAsked - 1) / kAsked;
  int before = 0;
  for (std::size_t i = 0; i < vertices.size(); i += stride)
    before += sideOf(asked_, placement.tree.toPair() * vertices[i]);
  return before < 0;
}

// Bullet knows triangles alone: vertices and edges go by one of theirs, and what is merely deep by the nearest.
ContactId MeshGround::idOf(const Near& near, const FeatureContact& contact) const {
  const ContactId id = featureIdsOf(contact);
  const auto part = id.otherPart < 0 ? std::nullopt : std::optional(static_cast<ContactPart>(id.otherPart));
  const SurfaceFeatures& features = surface_->view(isReversed_).features();
  const TriangleSoup::Source* source = nullptr;
  if (part == ContactPart::face)
    source = &surface_->source(contact.featureB);
  else if (part == ContactPart::edge)
    source = &surface_->source(features.edges()[contact.featureB].triangle[0]);
  else if (part == ContactPart::vertex)
    source = &surface_->source(features.edges()[features.edgesAround(contact.featureB).front()].triangle[0]);
  else
    source = &near.soup.triangles()[nearestOf(near.inPair, contact.position)];
  return {id.treePart, id.treeIndex, source->part, source->index};
}

std::uint32_t MeshGround::inSoup(const TriangleSoup& soup, const Contact& contact) {
  TriangleSoup::Source wanted;
  wanted.part = contact.id.otherPart;
  wanted.index = contact.id.otherIndex;
  return static_cast<std::uint32_t>(std::max(soup.find(wanted), 0));
}

}  // namespace cairn::bullet
