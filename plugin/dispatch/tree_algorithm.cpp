// SPDX-License-Identifier: Zlib
#include "dispatch/tree_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <utility>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

TreeAlgorithm::TreeAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                             std::shared_ptr<NarrowPhase::Impl> narrowPhase, const TreeAlgorithmFor& pair)
    : btCollisionAlgorithm(info),
      narrowPhase_(std::move(narrowPhase)),
      pair_(narrowPhase_->acquire(pair.kind)),
      mayDefer_(pair.mayDefer) {
  pair_->handles.setAlgorithm(this);
  if (pair.mayDefer) pair_->handles.served = pair.bodies;
}

TreeAlgorithm::~TreeAlgorithm() {
  pair_->manifolds.release(*m_dispatcher);
  narrowPhase_->release(pair_);
}

void TreeAlgorithm::processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                                     const btDispatcherInfo& info, btManifoldResult* result) {
  narrowPhase_->process(*pair_, *body0, *body1, info, *result, mayDefer_);
}

btScalar TreeAlgorithm::calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                              btManifoldResult*) {
  return 1;
}

void TreeAlgorithm::getAllContactManifolds(btManifoldArray& manifolds) {
  pair_->manifolds.append(manifolds);
}

}  // namespace cairn::bullet
