// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/pose.h"
#include "placement/bullet_math.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// The pose of a shape's tree frame, in the frame and unit of `body`, which is the pose of the shape's body.
inline Pose treePose(const SphereTreeShape& shape, const btTransform& body) {
  const btTransform fromTree = body * shape.bodyFromTree();
  return {toMat3d(fromTree.getBasis()), toVec3d(fromTree.getOrigin()), double(shape.scale())};
}

/// The shape's tree at the pose of its body, in a pair whose smaller body has this size.
inline PlacedTree placedTree(const SphereTreeShape& shape, const btTransform& body, float smallerSize) {
  return {shape.tree(), treePose(shape, body), shape.contactLevel(btScalar(smallerSize))};
}

}  // namespace cairn::bullet
