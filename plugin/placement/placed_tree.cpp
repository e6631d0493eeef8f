// SPDX-License-Identifier: Zlib
#include "placement/placed_tree.h"

#include "placement/bullet_math.h"

namespace cairn::bullet {

PlacedTree::PlacedTree(const SphereTree& tree, const Pose& pose)
    : tree_(&tree), pose_(pose), toPair_(toSimilarity(pose)) {
  const Mat3d inverse = transpose(pose.rotation);
  axesFromPair_ = {{Vec3(inverse.rows[0]), Vec3(inverse.rows[1]), Vec3(inverse.rows[2])}};
}

}  // namespace cairn::bullet
