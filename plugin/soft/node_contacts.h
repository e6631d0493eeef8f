// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletSoftBody/btSoftBody.h>

#include <cstdint>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "node_barrier.h"

namespace cairn::soft {

/// The pair of a soft body and a sphere-tree: contacts of nodes in each step, in the order of the nodes.
class NodeContacts final : public btCollisionAlgorithm {
 public:
  NodeContacts(const btCollisionAlgorithmConstructionInfo& info, bool isTreeFirst)
      : btCollisionAlgorithm(info), isTreeFirst_(isTreeFirst) {}

  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;  // the contacts look along each node's way themselves
  }
  void getAllContactManifolds(btManifoldArray&) override {}  // nodes' contacts are the soft body's own

 private:
  bool isTreeFirst_;
  NodeBarrierSearch search_;
  std::vector<std::uint32_t> guesses_;  // by node: the triangle that was nearest
};

}  // namespace cairn::soft
