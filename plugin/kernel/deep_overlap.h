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

/// Makes contacts for overlap deeper than local minima explain. Each region of overlap is pushed out in the direction
/// in which it shrinks fastest.
///
///     DeepOverlap deepOverlap;
///     deepOverlap.append(surfaces, limits, regions, contacts);
class DeepOverlap {
 public:
  /// Appends to `contacts`, which hold the local minima so far; those explain the points near them. Removes contacts
  /// among them that push against the way out of an unexplained region.
  void append(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const OverlapRegion> regions,
              std::vector<FeatureContact>& contacts);

 private:
  // Extent of a region along the way out: A's points from the lowest up, B's points from the highest down.
  struct Width {
    float lowest = 0, highest = 0;

    float width() const { return highest - lowest; }
  };

  void collectUnexplained(const OverlapRegion& region, const ContactLimits& limits,
                          std::span<const FeatureContact> explaining);
  Width widthAlong(const Vec3& normal) const;
  Vec3 narrowest(const SurfacePair& surfaces, const Vec3& way) const;
  void appendAlong(const Vec3& normal, float thickness, std::vector<FeatureContact>& contacts) const;

  std::span<const OverlapPoint> region_;  // current region
  std::vector<OverlapPoint> deep_;        // its points that need contacts
};

}  // namespace cairn::bullet
