// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>

#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "cairn/bullet/narrow_phase.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// A Bullet dispatcher whose pairs with a sphere-tree share one budget per step.
///
///     btDefaultCollisionConfiguration configuration;
///     cairn::bullet::Dispatcher<> dispatcher(&configuration);  // instead of btCollisionDispatcher
///     if (!dispatcher.setBudget({.operations = 50000})) return 1;
///
/// A pass over the pairs has three parts. First it collects the pairs with a sphere-tree; Bullet answers all others as
/// usual. Then one prioritised traversal refines the collected pairs together, until the budget is spent. Last it
/// writes their manifolds. Queries such as `contactTest` are answered at once, as are dispatches of a pair cache that
/// is not the world's.
///
/// `Base` is the dispatcher to extend; its constructor takes the arguments. For a dispatcher that already exists,
/// `install` (install.h) does the same from outside. Lifetime: worlds must be destroyed before their dispatcher, as
/// with any dispatcher of Bullet.
template <class Base = btCollisionDispatcher>
class Dispatcher : public Base {
 public:
  /// As `Base`'s, with the same arguments.
  template <class... Args>
  explicit Dispatcher(Args&&... args) : Base(std::forward<Args>(args)...), narrowPhase_(*this, kThreads) {}
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// The budget of each step. Fails for negative amounts and NaN.
  Status setBudget(const StepBudget& budget) { return narrowPhase_.setBudget(budget); }
  /// The budget of all steps of a frame together; it applies besides the budget of each step. Use `stepFrame` to step
  /// the world. Fails for negative amounts and NaN.
  Status setFrameBudget(const StepBudget& budget) { return narrowPhase_.setFrameBudget(budget); }
  /// See `NarrowPhase::expectPairs`.
  void expectPairs(const ExpectedPairs& pairs) { narrowPhase_.expectPairs(pairs); }
  /// See `NarrowPhase::beginFrame`.
  void beginFrame(int steps) { narrowPhase_.beginFrame(steps); }
  /// See `NarrowPhase::setUnresolved`.
  void setUnresolved(Unresolved policy) { narrowPhase_.setUnresolved(policy); }
  /// See `NarrowPhase::setFinest`.
  void setFinest(Finest finest) { narrowPhase_.setFinest(finest); }
  /// From the next step on; see `NarrowPhase::setPriority`. `Policy` is a `Priority`. Precondition: not null.
  template <class Policy>
  void setPriority(std::unique_ptr<Policy> priority) {
    narrowPhase_.setPriority(std::move(priority));
  }
  /// See `NarrowPhase::setViewer`.
  Status setViewer(const std::optional<Viewer>& viewer) { return narrowPhase_.setViewer(viewer); }
  /// See `NarrowPhase::lastStep`.
  const StepStatistics& lastStep() const { return narrowPhase_.lastStep(); }
  /// See `NarrowPhase::lastAnswers`.
  std::vector<PairAnswered> lastAnswers() const { return narrowPhase_.lastAnswers(); }

  /// One step: Bullet calls this with all its pairs.
  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    narrowPhase_.beginStep(*pairs, info);
    Base::dispatchAllCollisionPairs(pairs, info, dispatcher);
    narrowPhase_.endStep();
  }

 private:
  static constexpr DispatchThreads kThreads =
      std::is_base_of_v<btCollisionDispatcherMt, Base> ? DispatchThreads::several : DispatchThreads::one;

  NarrowPhase narrowPhase_;
};

}  // namespace cairn::bullet
