// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/surface_features.h"
#include "cairn/core/surface_patches.h"

namespace cairn {

class SphereTree;

/// What contacts ask of a tree's source mesh besides its vertices and triangles. Derived when the tree is made.
struct TreeSurface {
  SurfaceFeatures features;
  SurfacePatches patches;
  /// How thick the body is where it is thin, mesh units: a tenth of its surface has less of it behind. Infinite for a
  /// surface without an inside. See `surfaceThickness`.
  float thickness = 0;
};

/// The tenth percentile, by area, of the way from a face's middle straight inwards to where it leaves the body, over at
/// most `kThicknessSamples` faces. Some microseconds a sample.
float surfaceThickness(const SphereTree& tree);

inline constexpr std::uint32_t kThicknessSamples = 512;

}  // namespace cairn
