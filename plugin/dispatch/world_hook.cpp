// SPDX-License-Identifier: Zlib
#include "dispatch/world_hook.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <cassert>

#include "cairn/bullet/sphere_tree_shape.h"
#include "dispatch/narrow_phase_impl.h"
#include "dispatch/passing_broadphase.h"

namespace cairn::bullet {

namespace {

bool hasTree(const btCollisionShape& shape) {
  if (asSphereTree(&shape)) return true;
  if (!shape.isCompound()) return false;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    if (hasTree(*compound.getChildShape(i))) return true;
  return false;
}

bool isOfTree(const btBroadphaseProxy& proxy) {
  return hasTree(*static_cast<const btCollisionObject*>(proxy.m_clientObject)->getCollisionShape());
}

void forgetAlgorithms(btOverlappingPairCache& cache, btDispatcher& dispatcher) {
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i)
    if (pairs[i].m_algorithm && (isOfTree(*pairs[i].m_pProxy0) || isOfTree(*pairs[i].m_pProxy1)))
      cache.cleanOverlappingPair(pairs[i], &dispatcher);
}

// In the world's own cache and those of its ghosts.
void forgetAlgorithms(btCollisionWorld& world, btDispatcher& dispatcher) {
  forgetAlgorithms(*world.getPairCache(), dispatcher);
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    if (auto* ghost = dynamic_cast<btPairCachingGhostObject*>(world.getCollisionObjectArray()[i]))
      forgetAlgorithms(*ghost->getOverlappingPairCache(), dispatcher);
}

}  // namespace

void PassingPairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                                  const btDispatcherInfo& info) {
  const bool isStep = dispatcher == &dispatcher_;
  if (isStep) narrowPhase_.beginStep(*this, info);
  to().processAllOverlappingPairs(callback, dispatcher, info);
  if (isStep) narrowPhase_.endStep();
}

WorldHook::WorldHook(btCollisionWorld& world, btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase)
    : world_(world),
      dispatcher_(dispatcher),
      broadphase_(std::make_unique<PassingBroadphase>(*world.getBroadphase(), dispatcher, narrowPhase)) {
  forgetAlgorithms(world_, dispatcher_);
  world_.setBroadphase(broadphase_.get());
}

WorldHook::~WorldHook() {
  const bool isOurs = world_.getBroadphase() == broadphase_.get();
  assert(isOurs && "the world's broad phase was replaced while a narrow phase was installed on the world");
  if (isOurs) world_.setBroadphase(&broadphase_->original());
  forgetAlgorithms(world_, dispatcher_);
}

}  // namespace cairn::bullet
