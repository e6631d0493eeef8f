// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include "cairn/effects/ground_height.h"

namespace cairn::effects {

/// Whether a place (world frame) is in the layer that covers the ground up to `thickness` above it, m. All below the
/// ground is in the layer too; a layer of no thickness holds nothing, and there is none where there is no ground.
inline bool isInLayer(const GroundHeight& ground, btScalar thickness, const btVector3& place) {
  if (!(thickness > 0)) return false;
  const std::optional<btScalar> height = ground.at(place.x(), place.y());
  return height && place.z() - *height < thickness;
}

}  // namespace cairn::effects
