// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <memory>
#include <optional>
#include <utility>

#include "cairn/bullet/narrow_phase.h"

namespace cairn::bullet {

/// A Bullet dispatcher whose sphere-tree pairs share one budget per step.
///
/// In place of `btCollisionDispatcher d(&config)` write `cairn::bullet::Dispatcher<> d(&config)`; everything else
/// stays. One pass over the pairs collects those with a sphere-tree (all others are answered as ever), one prioritised
/// traversal refines them together until the budget is spent, then their manifolds are written. Queries (contactTest
/// and the like) and dispatches for a pair cache other than the world's are answered at once.
///
/// `Base` is the dispatcher to extend; its constructor's arguments are passed on. Where the dispatcher is made already,
/// `install` (install.h) does the same from outside. As with any dispatcher, the worlds it serves must die before it.
template <class Base = btCollisionDispatcher>
class Dispatcher : public Base {
 public:
  template <class... Args>
  explicit Dispatcher(Args&&... args) : Base(std::forward<Args>(args)...), narrowPhase_(*this) {}
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// Refuses negative amounts and NaN.
  Status setBudget(const StepBudget& budget) { return narrowPhase_.setBudget(budget); }
  /// Of all steps of a frame together, on top of that of each step; `stepFrame` then steps the world. Refuses negative
  /// amounts and NaN.
  Status setFrameBudget(const StepBudget& budget) { return narrowPhase_.setFrameBudget(budget); }
  /// See `NarrowPhase::expectPairs`.
  void expectPairs(const ExpectedPairs& pairs) { narrowPhase_.expectPairs(pairs); }
  void beginFrame(int steps) { narrowPhase_.beginFrame(steps); }
  void setUnresolved(Unresolved policy) { narrowPhase_.setUnresolved(policy); }
  void setFinest(Finest finest) { narrowPhase_.setFinest(finest); }
  /// Precondition: not null.
  void setPriority(std::unique_ptr<Priority> priority) { narrowPhase_.setPriority(std::move(priority)); }
  /// See `NarrowPhase::setViewer`.
  Status setViewer(const std::optional<Viewer>& viewer) { return narrowPhase_.setViewer(viewer); }
  /// See `NarrowPhase::lastStep`.
  const StepStatistics& lastStep() const { return narrowPhase_.lastStep(); }

  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    narrowPhase_.beginStep(*pairs, info);
    Base::dispatchAllCollisionPairs(pairs, info, dispatcher);
    narrowPhase_.endStep();
  }

 private:
  NarrowPhase narrowPhase_;
};

}  // namespace cairn::bullet
