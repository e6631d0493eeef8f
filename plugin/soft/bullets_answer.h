// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

namespace cairn::soft {

/// Bullet's own algorithm for two bodies, made when it is first wanted.
class BulletsAnswer {
 public:
  /// The dispatcher must outlive this object.
  explicit BulletsAnswer(btCollisionDispatcher& dispatcher) : dispatcher_(dispatcher) {}
  BulletsAnswer(const BulletsAnswer&) = delete;
  BulletsAnswer& operator=(const BulletsAnswer&) = delete;
  ~BulletsAnswer() {
    if (!algorithm_) return;
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }

  /// What the dispatcher's configuration makes algorithms of these types with.
  static btCollisionAlgorithmCreateFunc* functionOf(btCollisionDispatcher& dispatcher, int type0, int type1) {
    return dispatcher.getCollisionConfiguration()->getCollisionAlgorithmCreateFunc(type0, type1);
  }

  void process(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
               const btDispatcherInfo& info, btManifoldResult* result) {
    if (!algorithm_) {
      btCollisionAlgorithmConstructionInfo construction(&dispatcher_, 1);
      algorithm_ = functionOf(dispatcher_, body0->getCollisionShape()->getShapeType(),
                              body1->getCollisionShape()->getShapeType())
                       ->CreateCollisionAlgorithm(construction, body0, body1);
    }
    algorithm_->processCollision(body0, body1, info, result);
  }

 private:
  btCollisionDispatcher& dispatcher_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

}  // namespace cairn::soft
