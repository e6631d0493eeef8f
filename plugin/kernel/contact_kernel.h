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

/// What a pair remembers from step to step: what may touch, first of patches, then of their features. Either list holds
/// until a point of one body has moved by its skin against the other; the patches' skin is the wider one.
class KernelMemory {
 public:
  /// As new, but for the room it has.
  void forget() {
    near_.reset();
    features_.reset();
    lastAt_ = {};
    findingCost_ = overlapCost_ = tooFew_ = 0;
  }
  /// Frees memory that is not in use; nothing else changes.
  void shrinkToFit() {
    if (!near_) patches_.clear();
    if (!features_ || features_->skin <= 0) kept_ = {};
    patches_.shrink_to_fit();
    kept_.shrinkToFit();
  }
  /// Operations that contacts are expected to take where the bodies stand so; nothing where they were never found.
  /// What did not do before is a guess at it.
  std::optional<std::uint64_t> expectedCost(const RelativePlacement& placement) const;

 private:
  friend class ContactKernel;

  struct Listed {
    RelativePlacement at;
    float reach, skin;  // world length; so far the lists reach

    float movedBy(const RelativePlacement& placement) const {
      return static_cast<float>(placement.displacementSince(at));
    }
    bool holdsAt(const RelativePlacement& placement, float wanted) const {
      return skin > 0 && wanted <= reach && movedBy(placement) <= skin;
    }
  };

  std::optional<Listed> near_, features_;
  std::vector<PatchPair> patches_;
  CachedFeatures kept_;      // where `features_` says so
  std::size_t listed_ = 0;   // features, last time
  float minSeparation_ = 0;  // of what is not listed, where the patches were
  // Operations: to find the patches, and what overlaps, last time; and what was too few.
  std::uint64_t findingCost_ = 0, overlapCost_ = 0, tooFew_ = 0;
  RelativePlacement lastAt_;
};

/// The contacts of two surfaces: the local minima of the distance between them, and what overlaps deeper. See
/// docs/algorithms/contacts.md. One object serves many pairs, one after the other.
class ContactKernel {
 public:
  /// What `run` finds. Valid until the next one.
  struct Answer {
    std::span<const FeatureContact> contacts;
    float minSeparation = 0;  ///< world length: the surfaces are no nearer; minus infinity where they may touch
  };

  /// Nothing when the budget does not cover it: an operation for each pair of boxes and of features that is compared.
  std::optional<Answer> run(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                            const RelativePlacement& placement, Budget& budget);
  /// The same of a surface, with its margin, and a convex body. Remembers nothing.
  std::optional<Answer> run(const PlacedSurface& surface, ConvexBody& body, const ContactLimits& limits,
                            float surfaceMargin, Budget& budget);

 private:
  std::optional<Answer> answer(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                               const RelativePlacement& placement, Budget& budget);
  std::optional<FeatureSpans> list(const SurfacePair& surfaces, const ContactLimits& limits, KernelMemory& memory,
                                   const RelativePlacement& placement, Budget& budget);
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
