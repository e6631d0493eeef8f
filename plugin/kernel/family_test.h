// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/surface_patches.h"
#include "kernel/near_box.h"

namespace cairn::bullet {

/// A box as it stands in another frame, whose axes it need not be parallel to.
struct PlacedBox {
  Vec3 middle, half;  ///< of the axis-parallel box around it
};

/// What eight boxes are to one of the other side.
struct FamilyTest {
  std::uint32_t near = 0;  ///< a bit for each that may touch it once bodies have moved by the skin
  /// Of each: what may touch it is so far outside the box. Not positive where it may do so now.
  float margin[PatchFamily::kWidth];
  float minSeparation = 0;  ///< the others are no nearer; infinite if there are none
};

/// In the family's frame and unit. The same bits on every instruction set.
FamilyTest testFamily(const PatchFamily& family, const PlacedBox& box, const NearLimits& limits);

}  // namespace cairn::bullet
