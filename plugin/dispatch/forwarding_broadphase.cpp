// SPDX-License-Identifier: Zlib
#include "dispatch/forwarding_broadphase.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

void ForwardingPairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                                     const btDispatcherInfo& info) {
  const bool isStep = dispatcher == &dispatcher_;
  if (isStep) narrowPhase_.beginStep(*this, info);
  to().processAllOverlappingPairs(callback, dispatcher, info);
  if (isStep) narrowPhase_.endStep();
}

ForwardingBroadphase::ForwardingBroadphase(btCollisionWorld& world, const btDispatcher& dispatcher,
                                           NarrowPhase::Impl& narrowPhase)
    : world_(world), to_(*world.getBroadphase()), pairs_(to_, dispatcher, narrowPhase) {
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    if (world.getCollisionObjectArray()[i]->getBroadphaseHandle()) ++objects_;
}

btBroadphaseProxy* ForwardingBroadphase::createProxy(const btVector3& lower, const btVector3& upper, int shapeType,
                                                     void* user, int group, int mask, btDispatcher* dispatcher) {
  ++objects_;
  if (isLeft_ && world_.getBroadphase() == this) world_.setBroadphase(&to_);
  return to_.createProxy(lower, upper, shapeType, user, group, mask, dispatcher);
}

}  // namespace cairn::bullet
