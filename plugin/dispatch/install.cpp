// SPDX-License-Identifier: Zlib
#include "cairn/bullet/install.h"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <utility>

#include "dispatch/left_behind.h"
#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

// No pairs at all, which note whether they are asked for a pass.
struct NoPairs final : btNullPairCache {
  bool isAsked = false;
  void processAllOverlappingPairs(btOverlapCallback*, btDispatcher*) override { isAsked = true; }
  void processAllOverlappingPairs(btOverlapCallback*, btDispatcher*, const btDispatcherInfo&) override {
    isAsked = true;
  }
};

bool asksThePairs(btCollisionDispatcher& dispatcher) {
  NoPairs pairs;
  dispatcher.dispatchAllCollisionPairs(&pairs, btDispatcherInfo(), &dispatcher);
  return pairs.isAsked;
}

Status check(btCollisionDispatcher& dispatcher) {
  takeAwayLeftBehind(dispatcher);
  if (Registration::isOn(dispatcher))
    return Error{
        "sphere-trees are registered with this dispatcher already: it is a cairn::bullet::Dispatcher or one was "
        "installed before; use that, or destroy it first"};
  if (!asksThePairs(dispatcher))
    return Error{
        "the dispatcher does not show when it goes through the pairs, as a btCollisionDispatcherMt does not: make a "
        "cairn::bullet::Dispatcher<btCollisionDispatcherMt> in its place"};
  return {};
}

}  // namespace

Result<NarrowPhase> install(btCollisionWorld& world) {
  auto* const dispatcher = static_cast<btCollisionDispatcher*>(world.getDispatcher());
  if (!dispatcher) return Error{"the world has no dispatcher: sphere-trees are registered with that, give it one"};
  if (const Status status = check(*dispatcher); !status) return status.error();
  NarrowPhase narrowPhase(*dispatcher);
  narrowPhase.impl_->hook(world);
  return narrowPhase;
}

Result<NarrowPhase> install(btCollisionDispatcher& dispatcher) {
  if (const Status status = check(dispatcher); !status) return status.error();
  return NarrowPhase(std::make_shared<NarrowPhase::Impl>(dispatcher, StepEnd::open));
}

}  // namespace cairn::bullet
