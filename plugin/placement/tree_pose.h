// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/pose.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

/// The pose of a shape's tree frame, in the frame and unit of `body`, which is the pose of the shape's body.
inline Pose treePose(const SphereTreeShape& shape, const btTransform& body) {
  const btTransform fromTree = body * shape.bodyFromTree();
  return {toMat3d(fromTree.getBasis()), toVec3d(fromTree.getOrigin()), double(shape.scale())};
}

}  // namespace cairn::bullet
