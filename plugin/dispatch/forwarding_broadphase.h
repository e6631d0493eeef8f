// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "cairn/bullet/narrow_phase.h"

class btCollisionWorld;

namespace cairn::bullet {

/// A pair cache that forwards to another one. It tells the narrow phase when its dispatcher begins and ends a pass over
/// the pairs.
class ForwardingPairCache final : public btOverlappingPairCache {
 public:
  ForwardingPairCache(btBroadphaseInterface& broadphase, const btDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase)
      : broadphase_(broadphase), dispatcher_(dispatcher), narrowPhase_(narrowPhase) {}

  /// The dispatcher's pass. Only a pass of the narrow phase's own dispatcher is a step.
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                  const btDispatcherInfo& info) override;

  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) override {
    to().processAllOverlappingPairs(callback, dispatcher);
  }
  btBroadphasePair* getOverlappingPairArrayPtr() override { return to().getOverlappingPairArrayPtr(); }
  const btBroadphasePair* getOverlappingPairArrayPtr() const override { return to().getOverlappingPairArrayPtr(); }
  btBroadphasePairArray& getOverlappingPairArray() override { return to().getOverlappingPairArray(); }
  void cleanOverlappingPair(btBroadphasePair& pair, btDispatcher* d) override { to().cleanOverlappingPair(pair, d); }
  int getNumOverlappingPairs() const override { return to().getNumOverlappingPairs(); }
  bool needsBroadphaseCollision(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) const override {
    return to().needsBroadphaseCollision(proxy0, proxy1);
  }
  btOverlapFilterCallback* getOverlapFilterCallback() override { return to().getOverlapFilterCallback(); }
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* d) override { to().cleanProxyFromPairs(proxy, d); }
  void setOverlapFilterCallback(btOverlapFilterCallback* callback) override { to().setOverlapFilterCallback(callback); }
  btBroadphasePair* findPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) override {
    return to().findPair(proxy0, proxy1);
  }
  bool hasDeferredRemoval() override { return to().hasDeferredRemoval(); }
  void setInternalGhostPairCallback(btOverlappingPairCallback* callback) override {
    to().setInternalGhostPairCallback(callback);
  }
  void sortOverlappingPairs(btDispatcher* dispatcher) override { to().sortOverlappingPairs(dispatcher); }
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) override {
    return to().addOverlappingPair(proxy0, proxy1);
  }
  void* removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* d) override {
    return to().removeOverlappingPair(proxy0, proxy1, d);
  }
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* d) override {
    to().removeOverlappingPairsContainingProxy(proxy, d);
  }

 private:
  btOverlappingPairCache& to() const { return *broadphase_.getOverlappingPairCache(); }

  btBroadphaseInterface& broadphase_;
  const btDispatcher& dispatcher_;
  NarrowPhase::Impl& narrowPhase_;
};

/// A broad phase that forwards to another one, through a forwarding pair cache.
class ForwardingBroadphase final : public btBroadphaseInterface {
 public:
  ForwardingBroadphase(btCollisionWorld& world, const btDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);

  /// What everything is handed on to.

  btBroadphaseInterface& original() { return to_; }
  bool hasObjects() const { return objects_ > 0; }
  /// From now on the world gets its own back when it has something to be put into it.
  void leave() { isLeft_ = true; }

  /// The broad phase behind this one.
  bool isLeft() const { return isLeft_; }

  btOverlappingPairCache* getOverlappingPairCache() override { return &pairs_; }
  const btOverlappingPairCache* getOverlappingPairCache() const override { return &pairs_; }

  btBroadphaseProxy* createProxy(const btVector3& lower, const btVector3& upper, int shapeType, void* user, int group,
                                 int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    --objects_;
    to_.destroyProxy(proxy, dispatcher);
  }
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lower, const btVector3& upper, btDispatcher* d) override {
    to_.setAabb(proxy, lower, upper, d);
  }
  void getAabb(btBroadphaseProxy* proxy, btVector3& lower, btVector3& upper) const override {
    to_.getAabb(proxy, lower, upper);
  }
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lower,
               const btVector3& upper) override {
    to_.rayTest(from, to, callback, lower, upper);
  }
  void aabbTest(const btVector3& lower, const btVector3& upper, btBroadphaseAabbCallback& callback) override {
    to_.aabbTest(lower, upper, callback);
  }
  void calculateOverlappingPairs(btDispatcher* dispatcher) override { to_.calculateOverlappingPairs(dispatcher); }
  void getBroadphaseAabb(btVector3& lower, btVector3& upper) const override { to_.getBroadphaseAabb(lower, upper); }
  void resetPool(btDispatcher* dispatcher) override { to_.resetPool(dispatcher); }
  void printStats() override { to_.printStats(); }

 private:
  btCollisionWorld& world_;
  btBroadphaseInterface& to_;
  ForwardingPairCache pairs_;
  int objects_ = 0;  // in the world, by what was put in and taken out here
  bool isLeft_ = false;
};

}  // namespace cairn::bullet
