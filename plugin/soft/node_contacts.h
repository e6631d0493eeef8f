// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>

#include <memory>

#include "bullets_answer.h"
#include "soft_pair.h"

namespace cairn::soft {

/// What a Bullet world calls for a soft body and a sphere-tree. Asks in each step what Bullet asks of soft bodies, and
/// gives Bullet's answer where nodes are not to meet a tree.
class NodeContacts final : public btCollisionAlgorithm {
 public:
  NodeContacts(const btCollisionAlgorithmConstructionInfo& info, btCollisionDispatcher& dispatcher)
      : btCollisionAlgorithm(info), bullets_(dispatcher), pair_(std::make_unique<SoftPair>()) {}

  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;  // the contacts look along each node's way themselves
  }
  void getAllContactManifolds(btManifoldArray&) override {}  // nodes' contacts are the soft body's own

 private:
  BulletsAnswer bullets_;
  std::unique_ptr<SoftPair> pair_;  // apart: a dispatcher's pool has little room for an algorithm
};

}  // namespace cairn::soft
