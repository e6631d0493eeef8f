// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "contacts/relative_placement.h"
#include "kernel/crossings.h"
#include "kernel/deep_overlap.h"
#include "kernel/feature_contacts.h"
#include "kernel/overlap_regions.h"

namespace cairn::bullet {

/// What a pair remembers from step to step.
struct KernelMemory {
  FeatureLists lists;
  /// How the bodies stood when these were made, and how far they reach, world length; below 0: there are none.
  RelativePlacement listedAt;
  float listedReach = -1;
  /// The contacts of the last look at all that is listed, how the bodies stood, and whether any were of deep overlap.
  FeatureLists touching;
  RelativePlacement lookedAt;
  bool isDeep = false;

  /// Whether the lists hold still: until a point of one body has moved by the limits' skin against the other.
  bool isListedAt(const RelativePlacement& placement, const ContactLimits& limits) const;
  /// Whether the bodies have hardly moved since the last look: then these are asked again, and nothing else.
  bool isStillAt(const RelativePlacement& placement, const ContactLimits& limits) const;
  void remember(std::span<const FeatureContact> contacts, const RelativePlacement& placement);
};

/// The contacts of two surfaces: the local minima of the distance between them, and what overlaps deeper. See
/// docs/algorithms/contact-kernel.md. One object serves many pairs, one after the other.
class ContactKernel {
 public:
  /// What `run` finds. Valid until the next one.
  struct Answer {
    std::span<const FeatureContact> contacts;
    float apart = 0;  ///< world length: the surfaces are no nearer; minus infinity where they may touch
  };

  /// Nothing when the budget does not cover it: an operation for each pair of boxes and of features that is compared.
  std::optional<Answer> run(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits, KernelMemory& memory,
                            const RelativePlacement& placement, Budget& budget);

 private:
  void dropDeeper(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits);
  bool staysInside(const PlacedTree& a, const PlacedTree& b, const ContactLimits& limits, const FeatureContact& contact,
                   const FeatureContact& other);

  FeatureLister lister_;
  PlacedPair placed_;
  std::vector<FeatureContact> contacts_, shallow_;
  std::vector<Crossing> crossings_;
  OverlapRegions regions_;
  DeepOverlap deepOverlap_;
  SurfaceRay ray_;
};

}  // namespace cairn::bullet
