// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/overlap_regions.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// The patches that regions of overlap are made of: what overlaps deeper than contacts do is among their features.
class OverlapPatches {
 public:
  /// All pairs of them, ascending. Valid until the next call.
  std::span<const PatchPair> pairsOf(const SurfacePair& surfaces, std::span<const OverlapRegion> regions);

 private:
  // Those of one surface.
  class Side {
   public:
    void begin(const PlacedSurface& surface);
    void addVertex(std::uint32_t vertex);
    void addEdge(std::uint32_t edge);
    void addFace(std::uint32_t triangle) { add(surface_->patches().ownersOfTriangles()[triangle]); }
    std::span<const std::uint32_t> all();

   private:
    void add(std::uint32_t patch) {
      if (isNamed_[patch]) return;
      isNamed_[patch] = true;
      patches_.push_back(patch);
    }

    const PlacedSurface* surface_ = nullptr;
    std::vector<std::uint32_t> patches_;
    std::vector<bool> isNamed_;  // those of `patches_`, from `begin` on
  };

  Side a_, b_;
  std::vector<PatchPair> pairs_;
};

}  // namespace cairn::bullet
