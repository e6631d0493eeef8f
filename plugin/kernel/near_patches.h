// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// Which patches of two surfaces may touch, by their boxes: both trees of boxes are descended together, eight boxes at
/// a time.
class NearPatches {
 public:
  struct Pair {
    std::uint32_t a = 0, b = 0;
  };

  /// False when the budget does not cover the boxes that are compared. The same on every instruction set.
  bool find(const SurfacePair& surfaces, const ContactLimits& limits, Budget& budget);
  /// What the last `find` found.
  std::span<const Pair> found() const { return found_; }
  /// How far apart the surfaces are outside these at least, world length.
  float apart() const { return apart_; }

 private:
  // A box of one side, and the family of the other whose boxes it is compared with.
  struct Visit {
    Box box;
    bool isOfA = false, isPatch = false;
    std::uint32_t index = 0;  // the patch or the family that the box is around
    std::uint32_t family = 0;
  };

  void meet(const SurfacePair& surfaces, const Visit& visit, std::uint32_t lane);

  std::vector<Visit> waiting_;
  std::vector<Pair> found_;
  float apart_ = 0;
};

}  // namespace cairn::bullet
