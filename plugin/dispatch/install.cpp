// SPDX-License-Identifier: Zlib
#include "cairn/bullet/install.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <utility>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

Status check(btCollisionDispatcher& dispatcher) {
  if (Registration::isOn(dispatcher))
    return Error{
        "sphere-trees are registered with this dispatcher already: it is a cairn::bullet::Dispatcher or one was "
        "installed before; use that, or destroy it first"};
  if (dynamic_cast<btCollisionDispatcherMt*>(&dispatcher))
    return Error{
        "a btCollisionDispatcherMt does not show when it goes through the pairs: make a "
        "cairn::bullet::Dispatcher<btCollisionDispatcherMt> in its place"};
  return {};
}

}  // namespace

Result<NarrowPhase> install(btCollisionWorld& world) {
  auto* const dispatcher = dynamic_cast<btCollisionDispatcher*>(world.getDispatcher());
  if (!dispatcher)
    return Error{"the world's dispatcher is not a btCollisionDispatcher: sphere-trees cannot be registered with it"};
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
