// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/surface_patches.h"
#include "kernel/contact_limits.h"
#include "kernel/near_box.h"

namespace cairn::bullet {

/// A patch of A and a patch of B. No parts of them touch until some point of one body has moved by `margin`, a world
/// length, against the other.
struct PatchPair {
  std::uint32_t a = 0, b = 0;
  float margin = 0;
};

/// A patch of one surface, placed against the other surface.
struct PlacedPatch {
  SurfacePatch patch;
  // In the other surface's frame and unit:
  float columns[3 * SurfacePatch::kMaxFeatures];  ///< three columns of its vertices, each as long as the patch's own
  Box placed;                                     ///< box around its vertices
  // In its own frame and unit, at the present placement:
  Box near;                               ///< box around all that may touch its faces
  float nearLowest = 0, nearHighest = 0;  ///< range along `patch.facing` of all that may touch them
};

/// The patches of one surface, each placed once, when first needed: most are in several pairs.
class PlacedPatches {
 public:
  /// Starts a new surface. Both arguments must outlive the following calls.
  void begin(const PlacedSurface& side, const ContactLimits& limits);
  /// Precondition: `place` was called for this patch since `begin`.
  const PlacedPatch& operator[](std::uint32_t index) const { return placed_[slots_[index].slot]; }
  /// Places a patch, unless this was done since `begin`. Cost: linear in its vertices.
  void place(std::uint32_t index);
  /// Sets the skin, a world length. Placed patches stay valid for any skin.
  void setSkin(float skin) { limits_.setSkin(skin / scale()); }

  const NearLimits& limits() const { return limits_; }
  /// World length of the surface's unit.
  float scale() const { return side_->scale; }
  /// Sum of both surfaces' margins, world length.
  float margins() const { return limits_.margins * scale(); }

 private:
  struct Slot {
    std::uint32_t run = 0, slot = 0;
  };

  const PlacedSurface* side_ = nullptr;
  NearLimits limits_;
  std::vector<PlacedPatch> placed_;  // the first `count_` belong to this run
  std::uint32_t count_ = 0;
  std::vector<Slot> slots_;  // by patch; an older `run` means not placed
  std::uint32_t run_ = 0;
};

}  // namespace cairn::bullet
