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

  /// False when the budget does not cover the boxes that are compared.
  bool find(const SurfacePair& surfaces, const ContactLimits& limits, Budget& budget);
  /// What the last `find` found.
  std::span<const Pair> found() const { return found_; }
  /// How far apart the surfaces are outside these at least, world length.
  float apart() const { return apart_; }

 private:
  std::vector<Pair> waiting_, found_;
  float apart_ = 0;
};

}  // namespace cairn::bullet
