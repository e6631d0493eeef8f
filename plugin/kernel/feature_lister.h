// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/feature_lists.h"
#include "kernel/near_patches.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// Which features of patches may touch. Every feature is one patch's, so each pair is listed once.
class FeatureLister {
 public:
  /// Replaces `near` by all pairs of patches that may touch. False when the budget does not cover what is compared.
  bool findNear(const SurfacePair& surfaces, const ContactLimits& limits, std::vector<PatchPair>& near, Budget& budget);
  /// How far apart the surfaces are outside of what was found last, at least; world length.
  float apart() const { return nearPatches_.apart(); }
  /// Lists features of these pairs, found earlier or with a wider skin.
  bool list(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near,
            FeatureLists& lists, Budget& budget);
  /// The same of what `findNear` found last, within the limits it was given.
  bool listFound(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near,
                 FeatureLists& lists, Budget& budget);
  /// The same of these pairs as `list`, without what crosses.
  bool listTouching(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near,
                    FeatureLists& lists, Budget& budget);

 private:
  void place(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near);

  NearPatches nearPatches_;
  PlacedPatches a_, b_;
};

}  // namespace cairn::bullet
