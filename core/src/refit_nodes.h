// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>

#include "cairn/core/surface_depth.h"
#include "local_motion.h"
#include "refit_binding.h"

namespace cairn {

/// A moved mesh, and what its nodes were bound to; for one refit.
struct MovedMesh {
  const SphereTree& first;
  const RefitBinding& binding;
  std::span<const Vec3d> places;  ///< now
  SurfaceView surface;            ///< now
  double rounding = 0;            ///< no place or distance computed here is off by more
};

/// The node at its new place: ball, error, inner radius, and normal cone. See `TreeRefit` for why they hold.
NodeData refittedNode(const MovedMesh& mesh, std::uint32_t record, SurfaceDepthSearch& search);

/// The node's bound around the same places, where nodes have two spheres.
Sphere refittedBound(const MovedMesh& mesh, std::uint32_t record);

/// How the node's region moved: by the rotation, scale and translation that follow its places and normals best.
LocalMotion motionOf(const MovedMesh& mesh, std::uint32_t record);

}  // namespace cairn
