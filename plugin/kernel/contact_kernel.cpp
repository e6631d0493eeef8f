// SPDX-License-Identifier: Zlib
#include "kernel/contact_kernel.h"

#include <algorithm>
#include <limits>

#include "cairn/core/tree_surface.h"
#include "kernel/contact_tuning.h"

namespace cairn::bullet {

std::optional<ContactKernel::Answer> ContactKernel::run(const PlacedTree& a, const PlacedTree& b,
                                                        const ContactLimits& limits, KernelMemory& memory,
                                                        const RelativePlacement& placement, Budget& budget) {
  const SurfacePair surfaces = SurfacePair::of(a, b);
  const bool isListed = memory.isListedAt(placement, limits);
  if (!isListed) {
    memory.listedReach = -1;
    if (!lister_.list(surfaces, limits, memory.lists, budget)) return {};
    memory.listedAt = placement;
    memory.listedReach = limits.reach;
  }
  const bool isStill = isListed && memory.isStillAt(placement, limits);
  const FeatureLists& asked = isStill ? memory.touching : memory.lists;
  if (!budget.charge(kOverlapTestCost * asked.size())) return {};
  contacts_.clear();
  crossings_.clear();
  placed_.begin(surfaces);
  FeatureContacts(surfaces, placed_, limits).append(asked, contacts_);
  dropDeeper(a, b, limits);
  const float apart = memory.lists.apart - static_cast<float>(placement.displacementSince(memory.listedAt));
  if (isStill) return Answer{contacts_, apart};
  appendCrossings(surfaces, placed_, asked, crossings_);
  deepOverlap_.append(surfaces, limits, regions_.find(surfaces, crossings_, budget), contacts_);
  memory.remember(contacts_, placement);
  return Answer{contacts_, apart};
}

bool KernelMemory::isListedAt(const RelativePlacement& placement, const ContactLimits& limits) const {
  return limits.skin > 0 && limits.reach <= listedReach &&
         static_cast<float>(placement.displacementSince(listedAt)) <= limits.skin;
}

// Of those alone that a look at all of them found. What overlaps deeper changes from step to step.
bool KernelMemory::isStillAt(const RelativePlacement& placement, const ContactLimits& limits) const {
  const auto moved = static_cast<float>(placement.displacementSince(lookedAt));
  return !isDeep && moved <= tuning::kStill * limits.contactDistance;
}

void KernelMemory::remember(std::span<const FeatureContact> contacts, const RelativePlacement& placement) {
  touching.clear();
  lookedAt = placement;
  isDeep = false;
  for (const FeatureContact& c : contacts) {
    isDeep = isDeep || bullet::isDeep(c.kind);
    if (c.kind == FeatureKind::vertexOnFace) touching.verticesOnFaces.push_back({c.featureA, c.featureB});
    if (c.kind == FeatureKind::faceOnVertex) touching.facesOnVertices.push_back({c.featureA, c.featureB});
    if (c.kind == FeatureKind::edgeOnEdge) touching.edgesOnEdges.push_back({c.featureA, c.featureB});
  }
}

// Whether what a contact says to be inside the other body, margins and all, is so once A has moved out along `other`,
// and a little more.
bool ContactKernel::staysInside(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits,
                                const FeatureContact& contact, const FeatureContact& other) {
  const float more = tuning::kBeside * limits.contactDistance;
  const Vec3 way = other.normal * (std::max(-other.separation, 0.0F) + more);
  const Vec3 in = contact.normal * (0.5F * (contact.separation - limits.margins));
  if (contact.kind == FeatureKind::faceOnVertex) return ray_.isInside(a.tree(), a.toTree(contact.position - in - way));
  return ray_.isInside(b.tree(), b.toTree(contact.position + in + way));
}

// Where several features stop the same overlap the shallowest says the way out, if it is one: what stands in a corner
// is still below the floor when it has come out of the wall.
void ContactKernel::dropDeeper(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits) {
  const auto isOverruled = [&](const FeatureContact& c) {
    if (c.separation >= 0) return false;
    const float near = -tuning::kNearDepths * c.separation + tuning::kNearDistances * limits.contactDistance;
    return std::ranges::any_of(contacts_, [&](const FeatureContact& o) {
      return o.separation > tuning::kShallower * c.separation && dot(o.normal, c.normal) < tuning::kOtherWayCosine &&
             lengthSq(o.position - c.position) <= near * near && !staysInside(a, b, limits, c, o);
    });
  };
  shallow_.clear();
  for (const FeatureContact& contact : contacts_)
    if (!isOverruled(contact)) shallow_.push_back(contact);
  contacts_.swap(shallow_);
}

}  // namespace cairn::bullet
