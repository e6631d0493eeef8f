// SPDX-License-Identifier: Zlib
#include "kernel/contact_kernel.h"

#include <algorithm>
#include <limits>

#include "cairn/core/tree_surface.h"
#include "kernel/contact_tuning.h"

namespace cairn::bullet {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

ContactKernel::Answer ContactKernel::run(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits,
                                         std::span<const NodePair> leafPairs, DeepDirections& deep, Budget& budget) {
  const SurfacePair surfaces = SurfacePair::of(a, b);
  const FeatureContacts features(surfaces, limits);
  listPatchPairs(surfaces, leafPairs);
  contacts_.clear();
  crossings_.clear();
  float apart = kInfinity;
  const SurfacePatches &ofA = a.tree().surface().patches, &ofB = b.tree().surface().patches;
  for (const auto& [patchPair, leaves] : patchPairs_) {
    budget.chargeAnyway(kSphereUpdateCost);
    patches_.a = ofA.patch(static_cast<std::uint32_t>(patchPair >> 32));
    patches_.b = ofB.patch(static_cast<std::uint32_t>(patchPair));
    const BoxTest boxes = testBoxes(surfaces, limits, patches_.a, patches_.b);
    apart = std::min(apart, boxes.apart);
    if (!boxes.mayTouch) continue;
    testPatches(surfaces, limits, patches_);
    features.append(patches_, leaves, contacts_);
    appendCrossings(surfaces, patches_, leaves, crossings_);
  }
  makeUnique();
  dropDeeper(a, b, limits);
  const float thickness = a.tree().surface().thickness * a.scale() + b.tree().surface().thickness * b.scale();
  deepOverlap_.append(surfaces, limits, thickness, regions_.find(surfaces, crossings_), deep, contacts_);
  if (!contacts_.empty()) apart = -kInfinity;
  return {contacts_, apart};
}

void ContactKernel::listPatchPairs(const SurfacePair& surfaces, std::span<const NodePair> leafPairs) {
  patchPairs_.clear();
  const SurfacePatches &ofA = surfaces.a.surface().patches, &ofB = surfaces.b.surface().patches;
  for (const NodePair& pair : leafPairs) {
    const SurfacePatches::Range rangeA = ofA.patchesOf(pair.a), rangeB = ofB.patchesOf(pair.b);
    for (std::uint64_t i = rangeA.first; i < rangeA.first + rangeA.count; ++i)
      for (std::uint64_t j = rangeB.first; j < rangeB.first + rangeB.count; ++j) patchPairs_.emplace_back(i << 32 | j, pair);
  }
  std::ranges::stable_sort(patchPairs_, {}, [](const auto& p) { return p.first; });
  const auto isSame = [](const auto& x, const auto& y) { return x.first == y.first; };
  patchPairs_.erase(std::ranges::unique(patchPairs_, isSame).begin(), patchPairs_.end());
}

void ContactKernel::makeUnique() {
  std::ranges::sort(contacts_, {}, &FeatureContact::name);
  const auto isSame = [](const FeatureContact& x, const FeatureContact& y) { return x.name() == y.name(); };
  contacts_.erase(std::ranges::unique(contacts_, isSame).begin(), contacts_.end());
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
