// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>

#include "cairn/core/surface_patches.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// Pairs of features by their places in two patches' lists.
struct FeaturePairs {
  static constexpr std::uint32_t kMost = SurfacePatch::kMaxFeatures * SurfacePatch::kMaxFeatures;

  std::uint32_t count = 0;
  std::array<std::array<std::uint8_t, 2>, kMost> pairs;

  std::span<const std::array<std::uint8_t, 2>> all() const { return std::span(pairs).first(count); }
  void add(std::uint32_t first, std::uint32_t second) {
    assert(count < kMost);
    pairs[count++] = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second)};
  }
};

/// Two patches, and what of them may touch. Vectors find these pairs, a few more than there are; whoever asks decides
/// each one by itself.
struct PatchPair {
  SurfacePatch a, b;
  /// The vertices of each patch in the other's frame.
  struct Placed {
    alignas(64) float x[SurfacePatch::kMaxFeatures], y[SurfacePatch::kMaxFeatures], z[SurfacePatch::kMaxFeatures];

    Vec3 operator[](std::uint32_t i) const { return {x[i], y[i], z[i]}; }
  };
  Placed aInB, bInA;

  FeaturePairs verticesOnFaces;    ///< a vertex of A, a face of B
  FeaturePairs facesOnVertices;    ///< a face of A, a vertex of B
  FeaturePairs edgesOnEdges;       ///< convex ones
  FeaturePairs edgesThroughFaces;  ///< an edge of A, a face of B
  FeaturePairs facesThroughEdges;  ///< a face of A, an edge of B
};

/// Fills in all of `patches` but the patches themselves. The same on every instruction set.
void testPatches(const SurfacePair& surfaces, const ContactLimits& limits, PatchPair& patches);

}  // namespace cairn::bullet
