// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

class ForwardingBroadphase;

/// Ties a narrow phase's steps to a world's own pass over its pairs, by replacing the world's broad phase with a
/// forwarding one. On construction, pairs with a sphere-tree lose Bullet's algorithms. On destruction, pairs with
/// Cairn's algorithms and compounds lose theirs, so that the next pass makes new ones. Precondition: `world` outlives
/// this, and `dispatcher` is its dispatcher.
class WorldHook {
 public:
  WorldHook(btCollisionWorld& world, btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase);
  ~WorldHook();
  bool isOn(const btCollisionWorld& world) const { return &world_ == &world; }
  /// Whether objects are in the world: one that dies takes them out.
  bool hasObjects() const;
  /// The world gets its broad phase back when the next object comes, not at once: it may be gone. This must stay.
  void leave();
  WorldHook(const WorldHook&) = delete;
  WorldHook& operator=(const WorldHook&) = delete;

 private:
  btCollisionWorld& world_;
  btCollisionDispatcher& dispatcher_;
  NarrowPhase::Impl& narrowPhase_;
  std::unique_ptr<ForwardingBroadphase> broadphase_;
};

}  // namespace cairn::bullet
