// SPDX-License-Identifier: Zlib
#include "kernel/contact_kernel.h"

#include <algorithm>
#include <limits>

#include "cairn/core/tree_surface.h"
#include "kernel/contact_tuning.h"
#include "kernel/drop_deeper.h"
#include "kernel/explained.h"

namespace cairn::bullet {

namespace {

// Depth to which the lists reach: one contact distance into the surfaces.
float shallowDepth(const ContactLimits& limits) {
  return std::min(limits.trustedDepth, limits.contactDistance);
}

// Limits of the search for contacts deeper than the lists reach.
ContactLimits deeperThanListed(const ContactLimits& limits) {
  ContactLimits deeper = limits;
  deeper.maxSeparation = -limits.margins - shallowDepth(limits);
  deeper.skin = 0;
  return deeper;
}

// A skin that would not outlast the next step saves nothing, so it becomes 0.
float skinOr0(float skin, float moved) {
  return skin < moved ? 0 : skin;
}

// Whether the contact tells how deep the point is in the other body. The other body's face tells it of all points. The
// body's own face does not: all its points are equally deep behind it, even where the other body tilts away. The plane
// of two edges may be as good as such a face, so it tells of these edges alone.
bool tellsDepth(const FeatureContact& contact, const OverlapPoint& point) {
  if (contact.kind != FeatureKind::edgeOnEdge)
    return contact.kind == (point.isOfA ? FeatureKind::vertexOnFace : FeatureKind::faceOnVertex);
  return point.isCrossing && point.feature == (point.isOfA ? contact.featureA : contact.featureB);
}

// Whether some point overlaps by more than the shallow depth, unless these contacts account for it.
bool isAnyDeeper(std::span<const OverlapRegion> regions, std::span<const FeatureContact> contacts,
                 const ContactLimits& limits) {
  const float depth = limits.margins + shallowDepth(limits);
  const auto isKnown = [&](const OverlapPoint& point) {
    return isUnderAny(contacts, point.position, point.isOfA, limits, [&](const FeatureContact& contact) {
      return tellsDepth(contact, point) ? depth : -std::numeric_limits<float>::infinity();
    });
  };
  return std::ranges::any_of(regions,
                             [&](const OverlapRegion& region) { return !std::ranges::all_of(region.points, isKnown); });
}

}  // namespace

// New lists are expected to be about as long as the last ones.
std::optional<std::uint64_t> KernelMemory::expectedCost(const RelativePlacement& placement) const {
  if (!near_) return insufficient_ > 0 ? std::optional(insufficient_) : std::nullopt;
  const bool areNear = near_->holdsAt(placement, near_->maxSeparation);
  const bool areListed = areNear && features_ && features_->holdsAt(placement, near_->maxSeparation);
  const std::uint64_t listed = kOverlapTestCost * (listed_ + (areListed ? 0 : patches_.size()));
  return std::max(listed + (areNear ? overlapCost_ : findingCost_), insufficient_);
}

std::optional<ContactKernel::Answer> ContactKernel::run(const SurfacePair& surfaces, const ContactLimits& limits,
                                                        KernelMemory& memory, const RelativePlacement& placement,
                                                        Budget& budget) {
  const std::uint64_t before = budget.used();
  const std::optional<Answer> found = answer(surfaces, limits, memory, placement, budget);
  memory.insufficient_ = found ? 0 : budget.used() - before;
  return found;
}

std::optional<ContactKernel::Answer> ContactKernel::answer(const SurfacePair& surfaces, const ContactLimits& limits,
                                                           KernelMemory& memory, const RelativePlacement& placement,
                                                           Budget& budget) {
  ContactLimits shallow = limits;
  shallow.trustedDepth = shallowDepth(limits);
  const std::optional<FeatureSpans> lists = list(surfaces, shallow, memory, placement, budget);
  if (!lists || !budget.charge(kOverlapTestCost * memory.listed_)) return {};
  contacts_.clear();
  crossings_.clear();
  placed_.begin(surfaces);
  const std::uint64_t before = budget.used();
  const float moved = memory.features_->movedBy(placement) + limits.rounding();
  FeatureContacts(surfaces, placed_, shallow).append(*lists, moved, contacts_);
  appendCrossings(surfaces, placed_, *lists, moved, crossings_);
  const auto regions = regions_.find(surfaces, limits, contacts_, crossings_, budget);
  if (!regions || !appendDeeper(surfaces, limits, *regions, budget)) return {};
  shallow.overlap = deepestOf(contacts_);
  const std::uint64_t again = kOverlapTestCost * (memory.listed_ + deepLists_.size());
  if (shallow.overlap > limits.contactDistance && budget.charge(again))
    findTilted(surfaces, limits, shallow, *lists, moved);
  dropDeeper(contacts_, shallow_, limits, [&](const FeatureContact& contact, const FeatureContact& other) {
    return staysInside(surfaces, limits, contact, other);
  });
  deepOverlap_.append(surfaces, limits, *regions, contacts_);
  memory.overlapCost_ = budget.used() - before;
  if (!memory.patches_.empty()) return Answer{contacts_, -std::numeric_limits<float>::infinity()};
  return Answer{contacts_, memory.minSeparation_ - memory.near_->movedBy(placement)};
}

std::optional<ContactKernel::Answer> ContactKernel::run(const PlacedSurface& surface, ConvexBody& body,
                                                        const ContactLimits& limits, float surfaceMargin,
                                                        Budget& budget) {
  const auto contacts = convexContacts_.find(surface, body, limits, surfaceMargin, budget);
  if (!contacts) return {};
  return Answer{*contacts, -std::numeric_limits<float>::infinity()};
}

// Contacts deeper than the lists reach lie where surfaces cross, so only those patches are searched again.
bool ContactKernel::appendDeeper(const SurfacePair& surfaces, const ContactLimits& limits,
                                 std::span<const OverlapRegion> regions, Budget& budget) {
  deepLists_.clear();
  if (limits.trustedDepth <= shallowDepth(limits) || !isAnyDeeper(regions, contacts_, limits)) return true;
  const ContactLimits deeper = deeperThanListed(limits);
  const std::span<const PatchPair> pairs = overlapPatches_.pairsOf(surfaces, regions);
  lister_.begin(surfaces, deeper);
  if (!lister_.list(pairs, 0, Asked::touching, deepLists_, budget)) return false;
  if (!budget.charge(kOverlapTestCost * deepLists_.size())) return false;
  FeatureContacts(surfaces, placed_, deeper).append(deepLists_, 0, contacts_);
  return true;
}

// Decides the same lists again, now that `shallow` knows the deepest overlap. It may be that of a contact which
// `dropDeeper` drops later; then cones open more than they need. Without budget for it, the first contacts stay.
void ContactKernel::findTilted(const SurfacePair& surfaces, const ContactLimits& limits, const ContactLimits& shallow,
                               const FeatureSpans& lists, float moved) {
  contacts_.clear();
  FeatureContacts(surfaces, placed_, shallow).append(lists, moved, contacts_);
  ContactLimits deeper = deeperThanListed(limits);
  deeper.overlap = shallow.overlap;
  FeatureContacts(surfaces, placed_, deeper).append(deepLists_, 0, contacts_);
}

// Features are listed several times from the same patches: a narrow skin means fewer tests in each step. The skin is at
// least the displacement for which contacts are reused, so that a body at rest is not listed again. Without a skin no
// list is kept.
std::optional<FeatureSpans> ContactKernel::list(const SurfacePair& surfaces, const ContactLimits& limits,
                                                KernelMemory& memory, const RelativePlacement& placement,
                                                Budget& budget) {
  const auto moved = static_cast<float>(placement.displacementSince(memory.lastPlacement_));
  memory.lastPlacement_ = placement;
  const bool areNear = memory.near_ && memory.near_->holdsAt(placement, limits.maxSeparation);
  if (areNear && memory.features_ && memory.features_->holdsAt(placement, limits.maxSeparation))
    return memory.cached_.spans();
  memory.features_.reset();
  lister_.begin(surfaces, limits);
  if (!areNear) {
    memory.near_.reset();
    const float skin = skinOr0(tuning::kPatchSkin * limits.size, moved);
    lister_.setSkin(skin);
    const std::uint64_t before = budget.used();
    if (!lister_.findNear(memory.patches_, budget)) return {};
    memory.findingCost_ = budget.used() - before;
    memory.minSeparation_ = lister_.minSeparation();
    memory.near_ = {placement, limits.maxSeparation, skin};
  }
  const float sincePatches = memory.near_->movedBy(placement), left = memory.near_->skin - sincePatches;
  const float leastSkin = tuning::kReused * limits.contactDistance;
  const float skin = skinOr0(std::min(std::max(tuning::kListSteps * moved, leastSkin), left), moved);
  lister_.setSkin(skin);
  if (!lister_.list(memory.patches_, sincePatches, Asked::all, lists_, budget)) return {};
  if (skin > 0) memory.cached_.keep(lists_);
  memory.listed_ = lists_.size();
  memory.features_ = {placement, limits.maxSeparation, skin};
  return lists_;
}

// Whether a contact's point stays inside the other body, margins included, when A moves out along `other` and a little
// more.
bool ContactKernel::staysInside(const SurfacePair& surfaces, const ContactLimits& limits, const FeatureContact& contact,
                                const FeatureContact& other) {
  const float more = tuning::kExplainedSlack * limits.contactDistance;
  const Vec3 displacement = other.normal * (std::max(-other.separation, 0.0F) + more);
  const Vec3 toSurface = contact.normal * (0.5F * (contact.separation - limits.margins));
  if (contact.kind == FeatureKind::faceOnVertex)
    return ray_.isInside(surfaces.a.mesh, surfaces.a.fromPair(contact.position - toSurface - displacement));
  return ray_.isInside(surfaces.b.mesh, surfaces.b.fromPair(contact.position + toSurface + displacement));
}

}  // namespace cairn::bullet
