// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>

#include "cairn/bullet/step.h"
#include "cairn/core/result.h"
#include "cairn/core/scheduler.h"
#include "cairn/core/viewer.h"

class btCollisionDispatcher;
class btOverlappingPairCache;
struct btDispatcherInfo;

namespace cairn::bullet {

/// The sphere-tree narrow phase of one dispatcher: registers the collision algorithms, collects their pairs during a
/// dispatch, refines all of them under one budget and emits the contacts. Users meet it through `Dispatcher`.
class NarrowPhase {
 public:
  /// Registers with `dispatcher`, which must outlive this.
  explicit NarrowPhase(btCollisionDispatcher& dispatcher);
  ~NarrowPhase();
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;

  Status setBudget(const StepBudget& budget);
  void setUnresolved(Unresolved policy);
  /// Which pair is refined next; `RoundRobin` until told. See docs/algorithms/priorities.md. Precondition: not null.
  void setPriority(std::unique_ptr<Priority> priority);
  /// Who looks at the scene from the next step on, world frame, for priorities that care and for the seen error in the
  /// statistics; nothing (as at first): nobody. Holds for later priorities too. Refuses what `checkViewer` refuses.
  Status setViewer(const std::optional<Viewer>& viewer);
  const StepStatistics& lastStep() const;

  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  void endStep();

  class Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace cairn::bullet
