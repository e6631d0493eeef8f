// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// Which patches of two surfaces may touch, by their boxes: both trees of boxes are descended together.
class NearPatches {
 public:
  struct Pair {
    std::uint32_t a = 0, b = 0;
  };

  /// Valid until the next call. Charges the boxes that are compared, whatever is left of the budget.
  std::span<const Pair> find(const SurfacePair& surfaces, const ContactLimits& limits, Budget& budget);
  /// How far apart the surfaces are at least outside the pairs that the last `find` returned, world length.
  float apart() const { return apart_; }

 private:
  std::vector<Pair> waiting_, found_;
  float apart_ = 0;
};

}  // namespace cairn::bullet
