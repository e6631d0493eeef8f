// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "kernel/contact_limits.h"
#include "kernel/feature_lists.h"
#include "kernel/near_patches.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// Lists the features of two surfaces that may touch: first pairs of patches, then pairs of their features.
///
///     lister.begin(surfaces, limits);
///     if (!lister.findNear(patches, budget)) return {};
///     if (!lister.list(patches, 0, Asked::all, lists, budget)) return {};
class FeatureLister {
 public:
  /// Starts a new pair. `surfaces` must outlive the following calls.
  void begin(const SurfacePair& surfaces, const ContactLimits& limits);
  /// Sets the displacement, a world length, for which the following lists hold.
  void setSkin(float skin);
  /// Replaces `near` by all pairs of patches that may touch. Returns false when the budget does not suffice.
  bool findNear(std::vector<PatchPair>& near, Budget& budget);
  /// Lower bound on the separation of all surface outside the patches found last; world length.
  float minSeparation() const { return nearPatches_.minSeparation(); }
  /// Replaces `lists` by the features of these patches, each pair of features once. Returns false when the budget does
  /// not suffice. `near` may come from another source, a wider skin or another placement. `moved`: bound on the
  /// displacement since `near` was found, world length.
  bool list(std::span<const PatchPair> near, float moved, Asked asked, FeatureLists& lists, Budget& budget);

 private:
  const SurfacePair* surfaces_ = nullptr;
  ContactLimits limits_;
  NearPatches nearPatches_;
  PlacedPatches a_, b_;
};

}  // namespace cairn::bullet
