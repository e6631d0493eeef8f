// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/contact_limits.h"
#include "kernel/feature_contacts.h"
#include "kernel/overlap_regions.h"

namespace cairn::bullet {

/// Contacts of what overlaps deeper than local minima explain: each region is pushed out the way in which the overlap
/// shrinks fastest.
class DeepOverlap {
 public:
  /// Appends to `contacts`, whose first ones explain what they can; of these, what pushes against the way out goes.
  void append(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const OverlapRegion> regions,
              std::vector<FeatureContact>& contacts);

 private:
  // How far a region reaches along the way out: A's points from the lowest up, B's from the highest down.
  struct Width {
    float lowest = 0, highest = 0;

    float width() const { return highest - lowest; }
  };

  void leaveUnexplained(const OverlapRegion& region, const ContactLimits& limits,
                        std::span<const FeatureContact> explaining);
  Width widthAlong(const Vec3& normal) const;
  Vec3 narrowest(const SurfacePair& surfaces, const Vec3& way) const;
  void appendAlong(const Vec3& normal, std::vector<FeatureContact>& contacts) const;

  std::span<const OverlapPoint> region_;  // at hand
  std::vector<OverlapPoint> deep_;        // of it, what is to be told
};

}  // namespace cairn::bullet
