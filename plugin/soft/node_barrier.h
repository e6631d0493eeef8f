// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/core/surface_depth.h"
#include "cairn/core/surface_ray.h"
#include "cairn/core/tree_surface.h"

namespace cairn::soft {

/// The plane that a node may not pass. The mesh's frame and unit.
struct NodeBarrier {
  Vec3 normal;           ///< unit, out of the body
  float separation = 0;  ///< of the node's end from the plane; negative behind it
};

/// Finds what keeps a node out of a body. Keeps its working memory from one node to the next.
class NodeBarrierSearch {
 public:
  /// For a node that moves straight from `from` to `to` in a step. A way that may have met the surface is followed: the
  /// first face it enters by is the barrier, so that thin walls hold. Otherwise the barrier stands at the point of the
  /// surface that is nearest to `to`. Empty where `to` is farther than `margin` outside and no face was entered.
  /// `guess`: a triangle that may be near; set to one that is nearest. Precondition: closed, and `guess` is a triangle.
  std::optional<NodeBarrier> find(const SurfaceView& surface, const Vec3& from, const Vec3& to, float margin,
                                  std::uint32_t& guess);

 private:
  std::optional<NodeBarrier> entered(const SurfaceView& surface, const Vec3& from, const Vec3& to);
  SurfaceDepthSearch depth_;
  SurfaceRay ray_;
};

}  // namespace cairn::soft
