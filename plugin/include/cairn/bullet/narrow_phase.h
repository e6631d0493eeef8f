// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cairn/bullet/step.h"
#include "cairn/core/export.h"
#include "cairn/core/result.h"
#include "cairn/core/viewer.h"

class btCollisionDispatcher;
class btCollisionWorld;
class btOverlappingPairCache;
struct btDispatcherInfo;

namespace cairn {
class Priority;
}

namespace cairn::bullet {

/// Whether one thread goes through a dispatcher's pairs, or several.
enum class DispatchThreads : std::uint8_t {
  one,     ///< Bullet's plain dispatcher
  several  ///< `btCollisionDispatcherMt`
};

/// The sphere-tree narrow phase of one dispatcher. It registers the collision algorithms and collects their pairs
/// during a dispatch. Then it refines all pairs under one budget and writes the contacts. You meet it inside a
/// `Dispatcher`, or as the result of `install`:
///
///     Result<NarrowPhase> narrowPhase = cairn::bullet::install(world);
///     if (narrowPhase) narrowPhase.value().setFinest(Finest::leaves);
///
/// Its destructor removes all it registered. Do not destroy it during a dispatch (asserted). One made by hand must be
/// destroyed before its dispatcher.
class CAIRN_BULLET_EXPORT NarrowPhase {
 public:
  /// Registers with `dispatcher`, which must outlive this object and have no sphere-trees registered. The caller marks
  /// steps with `beginStep` and `endStep`. Other callers use `install`.
  explicit NarrowPhase(btCollisionDispatcher& dispatcher, DispatchThreads threads = DispatchThreads::one);
  ~NarrowPhase();
  /// The dispatcher keeps its narrow phase: only the owner changes.
  NarrowPhase(NarrowPhase&&) noexcept;
  /// Ends the narrow phase held so far, as on destruction, and takes over the other.
  NarrowPhase& operator=(NarrowPhase&&) noexcept;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;

  /// The budget of each step, from now on. Fails for negative amounts and NaN.
  Status setBudget(const StepBudget& budget);
  /// The budget of all steps of a frame together (see `FrameBudget`); it applies besides the budget of each step. Fails
  /// for negative amounts and NaN.
  Status setFrameBudget(const StepBudget& budget);
  /// Allocates memory now for so many pairs that are still to come, 8 to 9 KB each. Otherwise the step in which they
  /// meet allocates it. Under a budget in microseconds, touching new memory can take longer than all other work of that
  /// step. The first such budget makes room for 608 pairs by itself. A call within a step, from a callback, takes
  /// effect at the end of that step. Throws `std::bad_alloc` when there is no memory. Cost: linear in the pairs.
  void expectPairs(const ExpectedPairs& pairs);
  /// Begins a frame of `steps` steps; `stepFrame` calls this.
  void beginFrame(int steps);
  /// Sets the answer of unresolved pairs; `Unresolved::guard` at first.
  void setUnresolved(Unresolved policy);
  /// Sets where refinement ends, from the next step on. docs/budgets.md explains which pairs go on to triangles within
  /// a budget.
  void setFinest(Finest finest);
  /// Sets the rule that selects the next pair to refine; `RoundRobin` at first. Without a budget the rule is not asked.
  /// See docs/algorithms/priorities.md. Precondition: not null.
  void setPriority(std::unique_ptr<Priority> priority);
  /// Sets the viewer (world frame) from the next step on; unset, as at first, means no viewer. Priorities may use the
  /// viewer, and the statistics measure the seen error from there. Priorities set later get the same viewer. Fails
  /// where `checkViewer` fails.
  Status setViewer(const std::optional<Viewer>& viewer);
  /// Describes the last step. The reference is valid until the next call, or until this object is destroyed. Cost:
  /// none; linear in the pairs where installed on a dispatcher.
  const StepStatistics& lastStep() const;
  /// The last answers of all pairs, in no particular order. Pairs found apart have none; those of sleeping bodies keep
  /// theirs, which `lastStep` does not count. Pointers are valid until bodies are removed. Cost: linear in the pairs.
  std::vector<PairAnswered> lastAnswers() const;

  /// Call this before the dispatcher's pass over `pairs`.
  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  /// Call this after that pass.
  void endStep();

  class CAIRN_HIDDEN Impl;

 private:
  friend Result<NarrowPhase> install(btCollisionWorld& world);
  friend Result<NarrowPhase> install(btCollisionDispatcher& dispatcher);
  explicit NarrowPhase(std::shared_ptr<Impl> impl);
  void retire();

  std::shared_ptr<Impl> impl_;  // shared with the algorithms that Bullet still holds
};

}  // namespace cairn::bullet
