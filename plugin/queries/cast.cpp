// SPDX-License-Identifier: Zlib
#include "queries/cast.h"

#include "queries/ray_query.h"
#include "queries/sweep_query.h"

namespace cairn::bullet {

bool answerCast(const SphereTreeShape& shape, btTriangleCallback& callback) {
  if (auto* const ray = dynamic_cast<btTriangleRaycastCallback*>(&callback)) {
    castRay(shape, *ray);
    return true;
  }
  auto* const sweep = dynamic_cast<btTriangleConvexcastCallback*>(&callback);
  return sweep && castConvex(shape, *sweep);
}

}  // namespace cairn::bullet
