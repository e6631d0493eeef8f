// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

class ForwardingBroadphase;

/// Has a narrow phase's steps begin and end with a world's own pass over its pairs, by standing in for the world's
/// broad phase. On construction, pairs with a sphere-tree lose the algorithms Bullet knew for them, and on destruction
/// pairs with ours and compounds, so that the next pass asks the dispatcher for new ones. Precondition: `world`
/// outlives this; its dispatcher is `dispatcher`.
class WorldHook {
 public:
  WorldHook(btCollisionWorld& world, btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);
  ~WorldHook();
  WorldHook(const WorldHook&) = delete;
  WorldHook& operator=(const WorldHook&) = delete;

 private:
  btCollisionWorld& world_;
  btCollisionDispatcher& dispatcher_;
  std::unique_ptr<ForwardingBroadphase> broadphase_;
};

}  // namespace cairn::bullet
