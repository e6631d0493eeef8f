// SPDX-License-Identifier: Zlib
#include "dispatch/world_hook.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <cassert>

#include "dispatch/compound_algorithm.h"
#include "dispatch/forwarding_broadphase.h"
#include "dispatch/narrow_phase_impl.h"
#include "dispatch/tree_algorithm.h"

namespace cairn::bullet {

namespace {

bool isOfTree(const btBroadphaseProxy& proxy) {
  return hasTree(*static_cast<const btCollisionObject*>(proxy.m_clientObject)->getCollisionShape());
}

bool isOfTree(const btBroadphasePair& pair) {
  return isOfTree(*pair.m_pProxy0) || isOfTree(*pair.m_pProxy1);
}

// Looks at no shape: on teardown, shapes may be gone before their bodies.
bool mayBeOurs(const btBroadphasePair& pair) {
  return dynamic_cast<const TreeAlgorithm*>(pair.m_algorithm) ||
         dynamic_cast<const CompoundAlgorithm*>(pair.m_algorithm) ||
         dynamic_cast<const btCompoundCollisionAlgorithm*>(pair.m_algorithm);  // its children may have one
}

template <class IsWanted>
void forgetAlgorithms(btOverlappingPairCache& cache, btDispatcher& dispatcher, const IsWanted& isWanted) {
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i)
    if (pairs[i].m_algorithm && isWanted(pairs[i])) cache.cleanOverlappingPair(pairs[i], &dispatcher);
}

// In the world's own cache and in those of its ghosts.
template <class IsWanted>
void forgetAlgorithms(btCollisionWorld& world, btDispatcher& dispatcher, const IsWanted& isWanted) {
  forgetAlgorithms(*world.getPairCache(), dispatcher, isWanted);
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    if (auto* ghost = dynamic_cast<btPairCachingGhostObject*>(world.getCollisionObjectArray()[i]))
      forgetAlgorithms(*ghost->getOverlappingPairCache(), dispatcher, isWanted);
}

}  // namespace

WorldHook::WorldHook(btCollisionWorld& world, btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase)
    : world_(world),
      dispatcher_(dispatcher),
      broadphase_(std::make_unique<ForwardingBroadphase>(*world.getBroadphase(), dispatcher, narrowPhase)) {
  forgetAlgorithms(world_, dispatcher_, [](const btBroadphasePair& pair) { return isOfTree(pair); });
  world_.setBroadphase(broadphase_.get());
}

WorldHook::~WorldHook() {
  const bool isOurs = world_.getBroadphase() == broadphase_.get();
  assert(isOurs && "the world's broad phase was replaced while a narrow phase was installed on the world");
  if (isOurs) world_.setBroadphase(&broadphase_->original());
  forgetAlgorithms(world_, dispatcher_, mayBeOurs);
}

}  // namespace cairn::bullet
