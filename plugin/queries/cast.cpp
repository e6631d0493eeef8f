// SPDX-License-Identifier: Zlib
#include "queries/cast.h"

#include "queries/ball_query.h"
#include "queries/bullet_casts.h"
#include "queries/ray_query.h"
#include "queries/sweep_query.h"

namespace cairn::bullet {

bool answerCast(const SphereTreeShape& shape, const RegionBalls& regions, const LeafBalls* balls,
                btTriangleCallback& callback) {
  if (auto* const ray = asRay(callback)) {
    if (balls)
      castRayAtBalls(shape, *balls, *ray);
    else
      castRay(shape, regions, *ray);
    return true;
  }
  auto* const sweep = asSweep(callback);
  if (!sweep) return false;
  return balls ? castConvexAtBalls(shape, *balls, *sweep) : castConvex(shape, regions, *sweep);
}

}  // namespace cairn::bullet
