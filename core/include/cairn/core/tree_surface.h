// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cairn/core/export.h"
#include "cairn/core/surface_features.h"
#include "cairn/core/surface_patches.h"

namespace cairn {

/// The data about a mesh that contacts need besides vertices and triangles. A tree derives it from its source mesh when
/// it is made.
struct TreeSurface {
  SurfaceFeatures features;  ///< its edges and faces
  SurfacePatches patches;    ///< its triangles in small groups
  /// How thick the body is where it is thin, mesh units: a tenth of its surface has less of it behind. Infinite for a
  /// surface without an inside. See `surfaceThickness`.
  float thickness = 0;
};

/// A mesh with what is derived from it; refers to both, which must outlive it.
struct SurfaceView {
  std::span<const Vec3> vertices;                           ///< of the mesh
  std::span<const std::array<std::uint32_t, 3>> triangles;  ///< of the mesh: indices into `vertices`
  const TreeSurface* derived = nullptr;                     ///< not null when it is used

  /// The mesh's edges and faces.
  const SurfaceFeatures& features() const { return derived->features; }
  /// The mesh's triangles in small groups.
  const SurfacePatches& patches() const { return derived->patches; }
};

/// The tenth percentile, by area, of the way from a face's middle straight inwards to where it leaves the body, over at
/// most `kThicknessSamples` faces. Some microseconds a sample.
CAIRN_CORE_EXPORT float surfaceThickness(const SurfaceView& surface);

/// Faces that `surfaceThickness` looks through at most.
inline constexpr std::uint32_t kThicknessSamples = 512;

}  // namespace cairn
