// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <memory>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "node_barrier.h"

struct btCollisionObjectWrapper;

namespace cairn::soft {

/// A tree's mesh in the world.
struct PlacedMesh {
  std::shared_ptr<const SphereTree> tree;
  btTransform pose = btTransform::getIdentity();  ///< of the tree's frame, without its scale
  btScalar scale = 1;

  Vec3 toTree(const btVector3& point) const;
};

/// A soft body and a tree's mesh. Remembers mesh and pose from step to step, so that it is one whether nodes move, the
/// body does, or its mesh.
class SoftPair {
 public:
  /// Appends contacts of nodes to the soft body, in the order of the nodes. Once a step.
  void meet(btSoftBody& soft, const btCollisionObjectWrapper& tree, const bullet::SphereTreeShape& shape);

 private:
  /// Begins anew with another mesh; with the same one moved, tracks go on as mere guesses.
  void follow(const PlacedMesh& mesh, std::size_t nodes);
  /// Where a node began its step, in the frame of the mesh as it is now.
  Vec3 startOf(const btSoftBody::Node& node, const NodeTrack& track) const;

  NodeBarrierSearch search_;
  std::vector<NodeTrack> tracks_;  // by node
  PlacedMesh now_, before_;        // in this step, and in the last
};

}  // namespace cairn::soft
