// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "cairn/bullet/frame_budget.h"
#include "cairn/bullet/narrow_phase.h"
#include "cairn/core/tree_pair_traversal.h"
#include "dispatch/create_functions.h"
#include "dispatch/open_step.h"
#include "dispatch/overrun.h"
#include "dispatch/step_plan.h"
#include "dispatch/step_tally.h"
#include "dispatch/thread_cpu_clock.h"
#include "dispatch/world_hook.h"
#include "pairs/emission_pace.h"
#include "pairs/pair_begin.h"
#include "pairs/pair_carry.h"
#include "pairs/pair_fetch.h"
#include "pairs/pair_finish.h"
#include "pairs/pair_hold.h"
#include "pairs/pair_settle.h"
#include "pairs/pair_survey.h"

namespace cairn::bullet {

/// Whether somebody says when a step ends. If not, pairs are answered as they come: see `open_step.h`.
enum class StepEnd : std::uint8_t { told, open };

/// One step: `beginStep`, then Bullet's own pass, in which every algorithm calls `process` and is collected or answered
/// at once, then `endStep`. Only `process`, `acquire` and `release` may be called from several threads, and these only
/// where the end of a step is told.
class NarrowPhase::Impl final : public std::enable_shared_from_this<NarrowPhase::Impl>, private TurnListener {
 public:
  Impl(btCollisionDispatcher& dispatcher, StepEnd stepEnd);
  /// Has steps begin and end with the world's own pass. Precondition: the dispatcher is the world's.
  void hook(btCollisionWorld& world);
  /// Leaves dispatcher and world as they were; what algorithms are left are answered at once and in full.
  void retire();

  Status setBudget(const StepBudget& budget);
  Status setFrameBudget(const StepBudget& budget);
  void beginFrame(int steps);
  void setUnresolved(Unresolved policy) { policy_ = policy; }
  void setFinest(Finest finest) { finest_ = finest; }
  void setPriority(std::unique_ptr<Priority> priority);
  Status setViewer(const std::optional<Viewer>& viewer);
  const StepStatistics& lastStep();

  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  void endStep();

  using PairCounts = std::array<std::size_t, kCounterpartKinds>;
  /// Makes as many idle pairs of each kind as these, if there are fewer: the first step of a scene would otherwise take
  /// most of its time for memory. Within a step, which walks its lists, that is left for its end.
  void reserve(const PairCounts& pairs);
  /// Pair states are pooled and never freed before this is: a pair that comes back costs no allocation.
  TreePair* acquire(CounterpartKind kind);
  void release(TreePair* pair);

  /// `mayDefer`: false for query algorithms.
  void process(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
               const btDispatcherInfo& info, btManifoldResult& result, bool mayDefer);

 private:
  // Collecting (narrow_phase_collect.cpp).
  void takeTime(const btDispatcherInfo& info);
  bool collect(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  void countBroken();
  void tellOfBroken();
  void noteCompound(TreePair& pair);
  std::uint32_t settleLeftOvers(bool alsoCollected);
  void answerAtOnce(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                    const btDispatcherInfo& info, btManifoldResult& result);
  bool isWorlds(btOverlappingPairCache& pairs);
  void fetchPairsAskedNext(TreePair& pair);

  StepBudget stepLimit() const { return tighter(budget_, frame_.share()); }
  static Budget budgetOf(const StepBudget& limit);
  bool mayBeInterrupted() const;
  Outlook outlook() const {
    const bool asksTriangles = finest_ == Finest::triangles;
    return {timeStep_, sweptTime_, asksTriangles ? timeStep_ : btScalar(0), asksTriangles};
  }
  AnswerPolicy answerPolicy() const { return {policy_, finest_, mayBeInterrupted()}; }
  bool finishesResolvedAtOnce() const;
  void orderPairs();
  void nameNewPairs();
  StepMeans means() const;
  bool isPlanned() const;
  void planStep();
  void refinePairs();
  Progress serveAlone(std::size_t index);
  void promiseHolding();
  void holdPairs();
  void holdPair(std::size_t index, bool isLate);
  PairReport hold(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate);
  bool isMostOfAStep(const Promise& promise) const;
  bool isTooLateFor(std::size_t pairs) const;
  void fetchHeldAfter(std::size_t index, bool isLate) const;
  void finishBegunPairs();
  bool finishResolvedPairs();
  Progress resumePairs();
  void learnUpdates(std::uint64_t operationsBefore, Budget::Clock::time_point began);
  void beginPairs();
  void beginPair(std::size_t index);
  bool carriesOver(std::size_t index);
  bool carriesPairsOver() const;
  void fetchPairsAfter(std::size_t index) const;
  void turnEnded(std::size_t index, Progress progress, Budget& budget) override;
  void finishPair(std::size_t index);
  Remeasured remeasuredOf(const TreePair& pair) const;
  void bookTo(TreePair& pair, const Budget& budget);
  void learnFromStep();
  void adoptPriority();
  void reserveForDeadlines();
  void endAnswering();
  void dismiss(std::size_t index);
  PairReport count(PairReport report, const ScheduledPair& pair);

  // Open steps (open_step_answers.cpp).
  bool answerInOpenStep(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                        const btDispatcherInfo& info, btManifoldResult& result);
  bool answerOpenly(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                    btManifoldResult& result);
  void beginOpenStep();
  void endOpenStep();
  StepTally withOutstanding() const;
  void dropUnansweredPairs();
  bool refineNewcomer(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  void bookRefinement(const Budget& used, Budget::Clock::time_point began);
  void book(const Budget& used, Budget::Clock::time_point began);

  btCollisionDispatcher& dispatcher_;
  const StepEnd stepEnd_;
  const bool hasThreads_;  // Bullet's own pairs are answered by several
  bool isRetired_ = false;
  bool isAnswering_ = false;  // users' callbacks may be called
  StepBudget budget_;
  Budget left_ = Budget::unlimited();  // of the current step's
  Budget::Clock::time_point began_;    // when the current step did
  std::optional<double> planned_;      // microseconds the current step was planned to take
  EmissionPace pace_;
  EmissionPace updatePace_;              // of all that is done for a pair that is not held
  EmissionPace holdingPace_{kHoldPace};  // of one that is
  EmissionPace latePace_{kHoldPace};     // of one that is when it is too late for that
  Overrun overrun_;
  StepPlan plan_;
  Promise holding_;                // held back for those the plan holds
  double usualOperations_ = 300;   // that a pair is resolved with, from its start
  std::uint64_t bookedUntil_ = 0;  // operations of this step that were charged to a pair
  FrameBudget frame_;
  bool hasFrameBudget_ = false;
  Unresolved policy_ = Unresolved::guard;
  Finest finest_ = Finest::triangles;
  std::unique_ptr<Priority> priority_, nextPriority_;
  std::optional<PairCounts> nextRoom_;
  bool hasRoomForDeadlines_ = false;
  std::optional<Viewer> viewer_;
  Scheduler scheduler_;
  StepTally tally_;

  // Two turns, contacts included about three microseconds.
  static constexpr std::uint64_t kLeastOperations = 160;
  // 150 nanoseconds for a pair, until it is known better.
  static constexpr double kHoldPace = 5;
  static constexpr double kLearning = 1.0 / 16;
  static constexpr std::uint64_t kEndless = Budget::kUnlimited / 2;
  // Made ahead for who sets a deadline, about five megabytes: trees, planes, convex shapes, triangles, fields,
  // terrains.
  static constexpr PairCounts kReserved{256, 128, 32, 32, 32, 128};
  static constexpr std::uint64_t kStepsOfThrift = 4;
  // How many pairs ahead what one needs is fetched.
  static constexpr std::size_t kStatesAhead = 3, kListsAhead = 2, kLeafPairsAhead = 1;
  static constexpr std::size_t kHeldBetweenLooks = 8;  // pairs, at the time
  // In a row in which no time was left for any pair that can be held: without a turn now and then none would end.
  static constexpr std::uint32_t kMostStepsWithoutTurn = 7;
  static constexpr std::size_t kHeldAhead = 5, kHeldBodiesAhead = 3, kHeldPointsAhead = 2, kNamesAhead = 8;
  std::uint32_t updated_ = 0;  // pairs begun in this step
  std::uint32_t stepsWithoutTurn_ = 0;
  std::uint64_t firstLate_ = 0;  // the name of the first pair held in the last step for which it was too late
  bool isScarce_ = false;        // the last step left pairs unresolved
  std::uint64_t step_ = 0;       // that were collected

  bool isCollecting_ = false;
  const btOverlappingPairCache* worldPairs_ = nullptr;  // only compared: the last that had pairs and was no ghost's
  btScalar timeStep_ = 0, sweptTime_ = 0;               // seconds
  ThreadCpuClock::time_point stepBegan_;
  std::atomic<std::uint32_t> apartPairs_{0}, brokenPairs_{0};
  std::atomic<bool> hasToldOfBroken_{false};
  std::mutex mutex_;                  // guards what follows while algorithms run
  std::vector<TreePair*> collected_;  // null: finished, or destroyed after it was collected
  // The order in which Bullet asks about pairs hardly changes: up to here as in this step, from here on as in the last.
  std::vector<TreePair*> asked_;
  std::atomic<std::size_t> askedUntil_{0};
  std::vector<std::unique_ptr<TreePair>> all_;
  std::array<std::vector<TreePair*>, kCounterpartKinds> idle_;
  std::vector<TreePair*> ofCompounds_;  // pairs in use that Bullet may keep without asking about them
  std::vector<TreePair*> leftOvers_;    // of these, while they are settled; null: destroyed since

  struct NewPair {
    PairKey key;
    TreePair* pair;
  };
  std::vector<NewPair> newPairs_;
  struct Named {
    std::uint64_t id;
    TreePair* pair;
  };
  std::vector<Named> named_;              // working memory of `orderPairs`
  std::vector<ScheduledPair> scheduled_;  // one for each collected pair
  TreePairTraversal nothing_;             // stands for the traversals of pairs that are finished or gone
  std::uint64_t nextId_ = 0;
  ContactScratch scratch_;
  OpenStep open_;
  StepTally told_;       // what was last told of an open step
  StepBudget openLeft_;  // for refinement in the open step at hand, triangles included
  Promise openHeld_;     // of it, for pairs that have still to come: their contacts, and newcomers
  std::optional<WorldHook> hook_;
  std::optional<Registration> registration_;  // last: algorithms may be made as soon as it stands
};

}  // namespace cairn::bullet
