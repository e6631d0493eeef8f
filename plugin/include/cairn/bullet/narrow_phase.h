// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>

#include "cairn/bullet/step.h"
#include "cairn/core/result.h"
#include "cairn/core/scheduler.h"
#include "cairn/core/viewer.h"

class btCollisionDispatcher;
class btCollisionWorld;
class btOverlappingPairCache;
struct btDispatcherInfo;

namespace cairn::bullet {

/// The sphere-tree narrow phase of one dispatcher: registers the collision algorithms, collects their pairs during a
/// dispatch, refines all of them under one budget and emits the contacts. Users meet it inside a `Dispatcher`, or as
/// what `install` returns; it is gone with all it registered when it is destroyed, which must happen before the
/// dispatcher is and not while that dispatches (asserted).
class NarrowPhase {
 public:
  /// Registers with `dispatcher`, which must outlive this and have no sphere-trees registered. Whoever calls this says
  /// with `beginStep` and `endStep` where steps begin and end; others call `install`.
  explicit NarrowPhase(btCollisionDispatcher& dispatcher);
  ~NarrowPhase();
  NarrowPhase(NarrowPhase&&) noexcept;
  NarrowPhase& operator=(NarrowPhase&&) noexcept;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;

  /// Of every step from now on. Refuses negative amounts and NaN.
  Status setBudget(const StepBudget& budget);
  /// Of all steps of a frame together (see `FrameBudget`), on top of that of each step. Refuses negative amounts and
  /// NaN.
  Status setFrameBudget(const StepBudget& budget);
  /// Makes room now for so many pairs that are still to come (8 to 9 KB each), so that the step in which they meet
  /// need not: under a budget in microseconds memory that is touched for the first time takes longer than the rest of
  /// it. The first such budget makes room for 608 by itself. Within a step, from a callback, that is left for its end.
  /// Throws `std::bad_alloc` when there is no memory. Linear in the pairs.
  void expectPairs(const ExpectedPairs& pairs);
  /// A frame of `steps` steps begins; `stepFrame` calls this.
  void beginFrame(int steps);
  void setUnresolved(Unresolved policy);
  /// From the next step on. Which pairs go on to triangles within a budget: see docs/budgets.md.
  void setFinest(Finest finest);
  /// Which pair is refined next; `RoundRobin` until told; not asked without a budget. See
  /// docs/algorithms/priorities.md. Precondition: not null.
  void setPriority(std::unique_ptr<Priority> priority);
  /// Who looks at the scene from the next step on, world frame, for priorities that care and for the seen error in the
  /// statistics; nothing (as at first): nobody. Holds for later priorities too. Refuses what `checkViewer` refuses.
  Status setViewer(const std::optional<Viewer>& viewer);
  /// What the last step did. Valid until it is asked for again or this dies. Cost: nothing; installed on a dispatcher,
  /// linear in its pairs.
  const StepStatistics& lastStep() const;

  /// Around the dispatcher's pass over `pairs`.
  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  void endStep();

  class Impl;

 private:
  friend Result<NarrowPhase> install(btCollisionWorld& world);
  friend Result<NarrowPhase> install(btCollisionDispatcher& dispatcher);
  explicit NarrowPhase(std::shared_ptr<Impl> impl);
  void retire();

  std::shared_ptr<Impl> impl_;  // shared with the algorithms that Bullet still holds
};

}  // namespace cairn::bullet
