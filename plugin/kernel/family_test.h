// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/surface_patches.h"
#include "kernel/near_box.h"

namespace cairn::bullet {

/// A box placed in another frame, whose axes it need not be parallel to.
struct PlacedBox {
  Vec3 middle, half;  ///< of the axis-parallel box around it
};

/// Result of testing the eight boxes of a family against one box of the other surface.
struct FamilyTest {
  std::uint32_t near = 0;  ///< bit i is set if box i may touch it once bodies have moved by the skin
  /// Per box: how far anything that may touch it is outside the box. Not positive where it may touch now.
  float margin[PatchFamily::kWidth];
  float minSeparation = 0;  ///< lower bound on the distance to all other boxes; infinite if there are none
};

/// Frame and unit: the family's. Gives the same bits on every instruction set. Cost: one vectorised pass.
FamilyTest testFamily(const PatchFamily& family, const PlacedBox& box, const NearLimits& limits);

}  // namespace cairn::bullet
