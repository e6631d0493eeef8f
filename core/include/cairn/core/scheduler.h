// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>

#include "cairn/core/budget.h"
#include "cairn/core/export.h"
#include "cairn/core/family.h"
#include "cairn/core/priority.h"

namespace cairn {

/// Listens to every turn, to use its results while they are in the cache. It charges its own work to the budget, and
/// may reserve for later work.
class TurnListener {
 public:
  virtual ~TurnListener() = default;
  /// `pair` is the index in the pairs of this step. Traversals may be abandoned, none may be started.
  virtual void turnEnded(std::size_t pair, Progress progress, Budget& budget) = 0;
};

/// Shares one budget over all pairs of a step.
class CAIRN_CORE_EXPORT Scheduler {
 public:
  /// Operations a pair may use before the next pair has its turn: about eight full families, long enough to amortise
  /// the switch, short enough that a hundred pairs all move within a ten-thousand-operation budget.
  static constexpr std::uint32_t kTurnOperations = 80;

  /// Operations of the longest single step of a traversal: a node's sphere is moved and its whole family tested. A turn
  /// of fewer may do nothing (`Scheduler.ShareOut_GivesEachThatIsUnfinishedAsMuchAsTheOthers`).
  static constexpr std::uint32_t kStepOperations = kSphereUpdateCost + kFamilyWidth * kOverlapTestCost;

  /// Refines until every pair is done or the budget is spent. `pairs` need not be sorted; they are sorted by id here.
  /// Precondition: ids unique, traversals started.
  Progress run(std::span<ScheduledPair> pairs, Priority& priority, Budget& budget, TurnListener* listener = nullptr);

  /// Shares so many operations among `chosen`, indices into `pairs`: round by round as much each as all that are
  /// unfinished can have, a turn at most, so that what some do not need goes to the others. Ends early when the budget
  /// does. Precondition: their traversals were started.
  void shareOut(std::span<const ScheduledPair> pairs, std::span<const std::size_t> chosen, std::uint64_t operations,
                Budget& budget, TurnListener* listener = nullptr);

  /// Refines one of `pairs` until it is done or the budget is spent, in turns as well. Precondition: its traversal was
  /// started.
  Progress runAlone(std::span<const ScheduledPair> pairs, std::size_t pair, Budget& budget,
                    TurnListener* listener = nullptr);
};

}  // namespace cairn
