// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/overlap_regions.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// Collects the patches that touch regions of overlap. Contacts deeper than ordinary ones lie among their features.
class OverlapPatches {
 public:
  /// All pairs of those patches, ascending. Valid until the next call.
  std::span<const PatchPair> pairsOf(const SurfacePair& surfaces, std::span<const OverlapRegion> regions);

 private:
  // The patches of one surface, each named once.
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
    std::vector<bool> isNamed_;  // true for those of `patches_`
  };

  Side a_, b_;
  std::vector<PatchPair> pairs_;
};

}  // namespace cairn::bullet
