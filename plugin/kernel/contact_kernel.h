// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "contacts/relative_placement.h"
#include "kernel/contact_limits.h"
#include "kernel/convex_contacts.h"
#include "kernel/crossings.h"
#include "kernel/deep_overlap.h"
#include "kernel/feature_contacts.h"
#include "kernel/feature_lister.h"
#include "kernel/near_patches.h"
#include "kernel/overlap_patches.h"
#include "kernel/overlap_regions.h"

namespace cairn::bullet {

/// The state of a pair between steps: which patches may touch, and which of their features. A list holds until a point
/// of one body has moved against the other by the list's skin. The patches have the wider skin.
class KernelMemory {
 public:
  /// Resets all state, but keeps allocated memory.
  void forget() {
    near_.reset();
    features_.reset();
    lastPlacement_ = {};
    findingCost_ = overlapCost_ = insufficient_ = 0;
  }
  /// Frees unused memory; nothing else changes.
  void shrinkToFit() {
    if (!near_) patches_.clear();
    if (!features_ || features_->skin <= 0) cached_ = {};
    patches_.shrink_to_fit();
    cached_.shrinkToFit();
  }
  /// Operations that contacts are expected to cost at this placement; empty if they were never found. After a failed
  /// attempt, the estimate is at least its cost.
  std::optional<std::uint64_t> expectedCost(const RelativePlacement& placement) const;

 private:
  friend class ContactKernel;

  struct Listed {
    RelativePlacement at;
    float maxSeparation, skin;  // world length; `maxSeparation`: up to which the list is complete

    float movedBy(const RelativePlacement& placement) const {
      return static_cast<float>(placement.displacementSince(at));
    }
    bool holdsAt(const RelativePlacement& placement, float wanted) const {
      return skin > 0 && wanted <= maxSeparation && movedBy(placement) <= skin;
    }
  };

  std::optional<Listed> near_, features_;
  std::vector<PatchPair> patches_;
  CachedFeatures cached_;    // valid while `features_` is set
  std::size_t listed_ = 0;   // number of features listed last
  float minSeparation_ = 0;  // of unlisted surface, at the patches' placement, world length
  // Operations: the last cost of finding patches, the last cost of the overlap, and a budget that was not enough.
  std::uint64_t findingCost_ = 0, overlapCost_ = 0, insufficient_ = 0;
  RelativePlacement lastPlacement_;
};

/// Finds the contacts of two surfaces: the local minima of the distance between them, and contacts of deeper overlap.
/// See docs/algorithms/contacts.md.
///
///     ContactKernel kernel;
///     if (auto answer = kernel.run(surfaces, limits, memory, placement, budget))
///       for (const FeatureContact& contact : answer->contacts) ...;
///
/// One object serves many pairs, one after the other.
class ContactKernel {
 public:
  /// The result of `run`, valid until the next `run`.
  struct Answer {
    std::span<const FeatureContact> contacts;
    /// Lower bound on the separation, world length; minus infinity where the surfaces may touch.
    float minSeparation = 0;
  };

  /// Finds the contacts of two surfaces. Empty when the budget does not suffice. Cost: an operation for each pair of
  /// boxes and each pair of features that is compared.
  std::optional<Answer> run(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                            const RelativePlacement& placement, Budget& budget);
  /// Finds the contacts of a surface, grown by `surfaceMargin` (world length), with a convex body. Keeps nothing
  /// between steps. Empty when the budget does not suffice.
  std::optional<Answer> run(const PlacedSurface& surface, ConvexBody& body, const ContactLimits& limits,
                            float surfaceMargin, Budget& budget);

 private:
  std::optional<Answer> answer(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                               const RelativePlacement& placement, Budget& budget);
  std::optional<FeatureSpans> list(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                                   const RelativePlacement& placement, Budget& budget);
  void findTilted(const SurfacePair& surfaces, const ContactLimits& limits, const ContactLimits& shallow,
                  const FeatureSpans& lists, float moved);
  bool appendDeeper(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const OverlapRegion> regions,
                    Budget& budget);
  bool staysInside(const SurfacePair& surfaces, const ContactLimits& limits, const FeatureContact& contact,
                   const FeatureContact& other);

  FeatureLister lister_;
  PlacedPair placed_;
  std::vector<FeatureContact> contacts_, shallow_;
  std::vector<Crossing> crossings_;
  OverlapRegions regions_;
  OverlapPatches overlapPatches_;
  FeatureLists lists_, deepLists_;
  DeepOverlap deepOverlap_;
  ConvexContacts convexContacts_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
