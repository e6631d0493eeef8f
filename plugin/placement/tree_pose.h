// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/pose.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

/// Where a shape's tree frame stands, in the frame and unit that `body`, the pose of the shape's body, is given in.
inline Pose treePose(const SphereTreeShape& shape, const btTransform& body) {
  const btTransform fromTree = body * shape.bodyFromTree();
  return {toMat3d(fromTree.getBasis()), toVec3d(fromTree.getOrigin()), double(shape.scale())};
}

}  // namespace cairn::bullet
