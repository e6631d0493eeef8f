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

/// What is known of a node from its last search.
struct NodeTrack {
  std::uint32_t triangle = 0;  ///< one that was nearest
  Vec3 place;                  ///< where the node was
  float clearance = 0;         ///< at least so far outside it was; zero where nothing is known, or inside
};

/// Finds what keeps a node out of a body. Keeps its working memory from one node to the next.
class NodeBarrierSearch {
 public:
  /// For a node that moves straight from `from` to `to` in a step. A way that may have met the surface is followed: the
  /// first face it enters by is the barrier, so that thin walls hold. Otherwise the barrier stands at the point of the
  /// surface that is nearest to `to`. Empty where `to` is at least `margin` outside and no face was entered. The track
  /// is of the same surface, or new; it saves searches and changes no answer. Precondition: closed.
  std::optional<NodeBarrier> find(const SurfaceView& surface, const Vec3& from, const Vec3& to, float margin,
                                  NodeTrack& track);

 private:
  std::optional<NodeBarrier> entered(const SurfaceView& surface, const Vec3& from, const Vec3& to);
  SurfaceDepthSearch depth_;
  SurfaceRay ray_;
};

/// Where a point goes with a triangle that moves from the first mesh to the second: the same shares of its sides, the
/// same height above it. A triangle without area leaves the point where it is.
Vec3 carried(const Vec3& point, const SurfaceView& first, const SurfaceView& second, std::uint32_t triangle);

}  // namespace cairn::soft
