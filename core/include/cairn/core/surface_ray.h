// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Where a ray meets a tree's source mesh first. Tree frame, mesh units.
struct SurfaceHit {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::uint32_t triangle = kNone;
  float distance = std::numeric_limits<float>::infinity();
  bool leaves = false;  ///< from inside the body
};

/// Casts rays; keeps its working memory from one to the next.
class SurfaceRay {
 public:
  /// `direction`: unit. `except`: a triangle that is not met, the one the ray starts from. Some microseconds.
  SurfaceHit cast(const SphereTree& tree, const Vec3& origin, const Vec3& direction,
                  std::uint32_t except = SurfaceHit::kNone);
  /// Whether a point is inside the body, by which side of the surface a ray meets first. Precondition: closed.
  bool isInside(const SphereTree& tree, const Vec3& point);

 private:
  std::vector<NodeId> stack_;
};

}  // namespace cairn
