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

/// Which features of two surfaces may touch.
class FeatureLister {
 public:
  /// Forgets the last pair. `surfaces` must outlive what follows.
  void begin(const SurfacePair& surfaces, const ContactLimits& limits);
  /// From now on lists hold until bodies have moved so far, a world length.
  void setSkin(float skin);
  /// Replaces `near` by all pairs of patches that may touch. False when the budget does not cover what is compared.
  bool findNear(std::vector<PatchPair>& near, Budget& budget);
  /// How far apart the surfaces are outside of what was found last, at least; world length.
  float minSeparation() const { return nearPatches_.minSeparation(); }
  /// Replaces `lists` by features of these pairs, each pair of features once. False as above. Patches may have been
  /// found with a wider skin, when the bodies stood elsewhere, or by something else. `moved`: as far as bodies may have
  /// moved since, a world length.
  bool list(std::span<const PatchPair> near, float moved, Asked asked, FeatureLists& lists, Budget& budget);

 private:
  const SurfacePair* surfaces_ = nullptr;
  ContactLimits limits_;
  NearPatches nearPatches_;
  PlacedPatches a_, b_;
};

}  // namespace cairn::bullet
