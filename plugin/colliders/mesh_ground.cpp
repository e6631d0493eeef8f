// SPDX-License-Identifier: Zlib
#include "colliders/mesh_ground.h"

#include <algorithm>

#include "cairn/bullet/sphere_tree_shape.h"
#include "colliders/feature_ids.h"
#include "kernel/contact_tuning.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

std::size_t nearestOf(std::span<const Triangle> triangles, const Vec3& point) {
  const auto distanceSq = [&](const Triangle& t) { return lengthSq(point - nearestOnTriangle(t, point).point); };
  return static_cast<std::size_t>(std::ranges::min_element(triangles, {}, distanceSq) - triangles.begin());
}

}  // namespace

void MeshGround::reset() {
  surface_.reset();
  hasChanged_ = false;
  place_ = Place::away;
  memory_.forget();
}

bool MeshGround::watch(const PairPlacement& placement, const Near& near) {
  if (near.soup.triangles().empty()) {
    place_ = Place::away;
    return false;
  }
  if (hasChanged_) return false;
  if (!surface_) surface_ = GroundSurface::of(near.shape);
  if (!surface_ || !surface_->isSolid()) return false;
  hasChanged_ = !isStillTheShapes(near.soup);
  if (hasChanged_) {
    surface_.reset();
    return false;
  }
  if (place_ == Place::away) place_ = isInside(placement) ? Place::inside : Place::outside;
  return place_ == Place::outside;
}

SurfacePair MeshGround::surfacesOf(const PairPlacement& placement) const {
  const PlacedTree& tree = placement.tree;
  const btTransform place = placement.other * btTransform(btQuaternion::getIdentity(), surface_->origin());
  const Pose pose{toMat3d(place.getBasis()), toVec3d(place.getOrigin()), 1};
  return SurfacePair::of(tree.contactMesh(), tree.pose(), surface_->view(), pose);
}

// Whether most of the sampled vertices are inside.
bool MeshGround::isInside(const PairPlacement& placement) {
  const SurfacePair surfaces = surfacesOf(placement);
  const std::span<const Vec3> vertices = surfaces.a.mesh.vertices;
  const std::size_t stride = (vertices.size() + tuning::kSampledVertices - 1) / tuning::kSampledVertices;
  std::size_t asked = 0, inside = 0;
  for (std::size_t i = 0; i < vertices.size(); i += stride, ++asked)
    inside += ray_.isInside(surfaces.b.mesh, surfaces.a.toOther * vertices[i]) ? 1 : 0;
  return 2 * inside > asked;
}

bool MeshGround::isStillTheShapes(const TriangleSoup& soup) const {
  return std::ranges::all_of(soup.triangles(), [&](const TriangleSoup::Source& source) {
    return surface_->triangleOf(source) != GroundSurface::kNone;
  });
}

std::optional<float> MeshGround::append(const MeshQuery& question, const PairPlacement& placement, const Near& near,
                                        std::vector<Contact>& contacts) {
  const SurfacePair surfaces = surfacesOf(placement);
  const float thinner =
      std::min(surfaces.a.mesh.derived->thickness * surfaces.a.scale, surfaces.b.mesh.derived->thickness);
  const ContactLimits limits =
      ContactLimits::of(placement.contactDistance(), placement.maxSeparation, thinner, placement.treeMargin);
  const std::optional<ContactKernel::Answer> answer =
      question.kernel.run(surfaces, limits, memory_, question.placement, question.budget);
  if (!answer) return {};
  for (const FeatureContact& found : answer->contacts) contacts.push_back(contactOf(found, idOf(near, found)));
  return answer->minSeparation;
}

// Bullet knows only triangles. A vertex or an edge gets one of its triangles, a deep contact without a feature the
// nearest.
ContactId MeshGround::idOf(const Near& near, const FeatureContact& contact) const {
  const ContactId id = featureIdsOf(contact);
  const auto part = id.otherPart < 0 ? std::nullopt : std::optional(static_cast<ContactPart>(id.otherPart));
  const SurfaceFeatures& features = surface_->view().features();
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
