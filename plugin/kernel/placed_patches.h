// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/surface_patches.h"
#include "kernel/contact_limits.h"
#include "kernel/near_box.h"

namespace cairn::bullet {

/// Two patches: one of A, one of B. Nothing of them touches before some point of one body has moved by the margin, a
/// world length, against the other.
struct PatchPair {
  std::uint32_t a = 0, b = 0;
  float margin = 0;
};

/// A patch of one surface, and how it stands to the other.
struct PlacedPatch {
  SurfacePatch patch;
  // In the other's frame and unit.
  float columns[3 * SurfacePatch::kMaxFeatures];  ///< of its vertices: three, each as long as the patch's own
  Box placed;                                     ///< of its vertices
  // In its own frame and unit, where bodies are.
  Box near;                               ///< of what may touch its faces
  float nearLowest = 0, nearHighest = 0;  ///< along `patch.facing`: of what may touch them
};

/// The patches of one surface, each placed when it is first asked for: most stand in several pairs.
class PlacedPatches {
 public:
  /// Forgets the last surface. Both must outlive the questions.
  void begin(const PlacedSurface& side, const ContactLimits& limits);
  /// Precondition: `place` was asked since `begin`.
  const PlacedPatch& operator[](std::uint32_t index) const { return placed_[slots_[index].slot]; }
  void place(std::uint32_t index);
  /// What is placed stands for any skin, a world length.
  void setSkin(float skin) { limits_.setSkin(skin / scale()); }

  const NearLimits& limits() const { return limits_; }
  /// World length of the surface's unit.
  float scale() const { return side_->scale; }
  /// Of both surfaces together, world length.
  float margins() const { return limits_.margins * scale(); }

 private:
  struct Slot {
    std::uint32_t run = 0, slot = 0;
  };

  const PlacedSurface* side_ = nullptr;
  NearLimits limits_;
  std::vector<PlacedPatch> placed_;  // the first so many of this run
  std::uint32_t count_ = 0;
  std::vector<Slot> slots_;  // by patch; of another run where nothing is placed
  std::uint32_t run_ = 0;
};

}  // namespace cairn::bullet
