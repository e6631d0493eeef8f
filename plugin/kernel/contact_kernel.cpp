// SPDX-License-Identifier: Zlib
#include "kernel/contact_kernel.h"

#include <algorithm>
#include <limits>

#include "cairn/core/tree_surface.h"
#include "kernel/contact_tuning.h"

namespace cairn::bullet {

ContactKernel::Answer ContactKernel::run(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits,
                                         KernelMemory& memory, Budget& budget) {
  const SurfacePair surfaces = SurfacePair::of(a, b);
  if (!memory.isListed) lister_.list(surfaces, limits, memory.lists, budget);
  memory.isListed = limits.skin > 0;
  contacts_.clear();
  crossings_.clear();
  placed_.begin(surfaces);
  FeatureContacts(surfaces, placed_, limits).append(memory.lists, contacts_);
  appendCrossings(surfaces, placed_, memory.lists, crossings_);
  dropDeeper(a, b, limits);
  deepOverlap_.append(surfaces, limits, regions_.find(surfaces, crossings_), contacts_);
  return {contacts_, memory.lists.apart};
}

// Whether what a contact says to be inside the other body is so once A has moved out along `other`, and a little more.
bool ContactKernel::staysInside(const PlacedTree& a, const PlacedTree& b, const FeatureContact& contact,
                                const FeatureContact& other, float more) {
  const Vec3 way = other.normal * (std::max(-other.separation, 0.0F) + more);
  const float half = 0.5F * contact.separation;
  if (contact.kind == FeatureKind::faceOnVertex) {
    return ray_.isInside(a.tree(), a.toTree(contact.position - contact.normal * half - way));
  }
  return ray_.isInside(b.tree(), b.toTree(contact.position + contact.normal * half + way));
}

// Where several features stop the same overlap the shallowest says the way out, if it is one: what stands in a corner
// is still below the floor when it has come out of the wall.
void ContactKernel::dropDeeper(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits) {
  const auto isOverruled = [&](const FeatureContact& c) {
    if (c.separation >= 0) return false;
    const float near = -tuning::kNearDepths * c.separation + tuning::kNearDistances * limits.contactDistance;
    return std::ranges::any_of(contacts_, [&](const FeatureContact& o) {
      return o.separation > tuning::kShallower * c.separation && dot(o.normal, c.normal) < tuning::kOtherWayCosine &&
             lengthSq(o.position - c.position) <= near * near &&
             !staysInside(a, b, c, o, tuning::kBeside * limits.contactDistance);
    });
  };
  shallow_.clear();
  for (const FeatureContact& contact : contacts_)
    if (!isOverruled(contact)) shallow_.push_back(contact);
  contacts_.swap(shallow_);
}

}  // namespace cairn::bullet
