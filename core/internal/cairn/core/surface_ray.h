// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/tree_surface.h"

namespace cairn {

/// Where a ray meets a mesh first. The mesh's frame and unit.
struct SurfaceHit {
  /// The triangle of a ray that meets nothing.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::uint32_t triangle = kNone;                           ///< the triangle that is met
  float distance = std::numeric_limits<float>::infinity();  ///< from the origin, along the direction
  bool leaves = false;                                      ///< from inside the body
};

/// Casts rays; keeps its working memory from one to the next.
class CAIRN_CORE_EXPORT SurfaceRay {
 public:
  /// `direction`: unit. `except`: a triangle that is not met, the one the ray starts from. Some microseconds.
  SurfaceHit cast(const SurfaceView& surface, const Vec3& origin, const Vec3& direction,
                  std::uint32_t except = SurfaceHit::kNone);
  /// Whether a point is inside the body, by which side of the surface rays meet first: two that agree, or of three the
  /// majority. Precondition: closed.
  bool isInside(const SurfaceView& surface, const Vec3& point);

 private:
  std::vector<std::uint32_t> waiting_;  // families of patches
};

}  // namespace cairn
