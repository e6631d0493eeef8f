// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/feature_contacts.h"
#include "kernel/overlap_regions.h"

namespace cairn::bullet {

/// The directions in which deep regions of a pair were pushed in the last step, pair frame.
struct DeepDirections {
  std::array<Vec3, 4> normal;
  std::size_t count = 0;
};

/// Contacts of what overlaps deeper than local minima explain: each region is pushed out along the direction in which it
/// is least wide.
class DeepOverlap {
 public:
  /// Appends to `contacts`, whose first ones explain what they can. `kept`: last step's directions, replaced by this
  /// one's. `thickness`: of both bodies together, world length.
  void append(const SurfacePair& surfaces, const ContactLimits& limits, float thickness,
              std::span<const OverlapPoint> points, DeepDirections& kept, std::vector<FeatureContact>& contacts);

 private:
  struct Width {
    Vec3 normal;
    float width = 0, lowest = 0, highest = 0;  // of A's points, of B's
  };

  void leaveUnexplained(std::span<const OverlapPoint> region, const ContactLimits& limits,
                        std::span<const FeatureContact> explaining);
  static void dropOpposed(std::span<const OverlapPoint> region, const Vec3& normal, const ContactLimits& limits,
                          std::vector<FeatureContact>& contacts, std::size_t& explaining);
  void gatherDirections(const SurfacePair& surfaces);
  void offer(const Vec3& normal);
  Width widthAlong(const Vec3& normal) const;
  Width leastWidth(const DeepDirections& kept) const;
  void appendRegion(const Width& least, std::vector<FeatureContact>& contacts) const;

  std::vector<OverlapPoint> region_;
  std::vector<Vec3> directions_;
  Vec3 mean_;
  std::size_t faces_ = 0;
};

}  // namespace cairn::bullet
