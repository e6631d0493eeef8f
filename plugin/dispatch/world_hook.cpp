// SPDX-License-Identifier: Zlib
#include "dispatch/world_hook.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <algorithm>

#include <cassert>

#include "dispatch/compound_algorithm.h"
#include "dispatch/forwarding_broadphase.h"
#include "dispatch/ghost_pairs.h"
#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

const btCollisionObject* objectOf(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

bool isOfTree(const btBroadphaseProxy& proxy) {
  return hasTree(*objectOf(proxy)->getCollisionShape());
}

// Looks at no shape: on teardown, shapes may be gone before their bodies.
bool isOfTree(const btBroadphasePair& pair) {
  return isOfTree(*pair.m_pProxy0) || isOfTree(*pair.m_pProxy1);  // its children may have one
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
    if (btOverlappingPairCache* pairs = ghostPairsOf(*world.getCollisionObjectArray()[i]))
      forgetAlgorithms(*pairs, dispatcher, isWanted);
}

}  // namespace

WorldHook::WorldHook(btCollisionWorld& world, btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase)
    : world_(world),
      dispatcher_(dispatcher),
      narrowPhase_(narrowPhase),
      broadphase_(std::make_unique<ForwardingBroadphase>(world, dispatcher, narrowPhase)) {
  forgetAlgorithms(world_, dispatcher_, [](const btBroadphasePair& pair) { return isOfTree(pair); });
  world_.setBroadphase(broadphase_.get());
}

bool WorldHook::hasObjects() const {
  return broadphase_->hasObjects();
}

void WorldHook::leave() {
  broadphase_->leave();
}

WorldHook::~WorldHook() {
  const bool isOurs = world_.getBroadphase() == broadphase_.get();
  assert((isOurs || broadphase_->isLeft()) &&
         "the world's broad phase was replaced while a narrow phase was installed on the world");
  if (isOurs) world_.setBroadphase(&broadphase_->original());
  // Looks at no shape: when all is taken down, they may be gone before their bodies.
  const std::vector<ServedPair> served = narrowPhase_.servedPairs();
  forgetAlgorithms(world_, dispatcher_, [&](const btBroadphasePair& pair) {
    return std::binary_search(served.begin(), served.end(),
                              ServedPair::of(objectOf(*pair.m_pProxy0), objectOf(*pair.m_pProxy1)));
  });
}

}  // namespace cairn::bullet
