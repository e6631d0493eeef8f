// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "dispatch/asked_pairs.h"
#include "dispatch/create_functions.h"
#include "dispatch/non_finite_pairs.h"
#include "dispatch/open_step_answers.h"
#include "dispatch/pair_pool.h"
#include "dispatch/step_answers.h"
#include "dispatch/step_clock.h"
#include "dispatch/step_refinement.h"
#include "dispatch/world_hook.h"

namespace cairn::bullet {

/// One step: `beginStep`, then Bullet's own pass, in which every algorithm calls `process` and is collected or answered
/// at once, then `endStep`. Only `process`, `acquire` and `release` may be called from several threads, and these only
/// where the end of a step is told.
class NarrowPhase::Impl final : public std::enable_shared_from_this<NarrowPhase::Impl> {
 public:
  Impl(btCollisionDispatcher& dispatcher, StepEnd stepEnd);
  /// Has steps begin and end with the world's own pass. Precondition: the dispatcher is the world's.
  void hook(btCollisionWorld& world);
  /// Leaves dispatcher and world as they were; what algorithms are left are answered at once and in full.
  void retire();

  StepRules& rules() { return step_.rules; }
  Status setBudget(const StepBudget& budget);
  Status setFrameBudget(const StepBudget& budget);
  void beginFrame(int steps);
  void setPriority(std::unique_ptr<Priority> priority);
  const StepStatistics& lastStep();
  /// Makes as many idle pairs of each kind as these, if there are fewer: the first step of a scene would otherwise take
  /// most of its time for memory. Within a step, which walks its lists, that is left for its end.
  void reserve(const PairCounts& pairs);

  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  void endStep();

  TreePair* acquire(ColliderKind kind);
  void release(TreePair* pair);
  /// `mayDefer`: false for query algorithms.
  void process(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
               const btDispatcherInfo& info, btManifoldResult& result, bool mayDefer);

 private:
  bool isWorlds(btOverlappingPairCache& pairs);
  void takeTime(const btDispatcherInfo& info);
  bool collect(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  void noteCompound(TreePair& pair);
  bool answerInOpenStep(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                        const btDispatcherInfo& info, btManifoldResult& result);
  void answerAtOnce(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                    const btDispatcherInfo& info, btManifoldResult& result);
  void answerCollected();
  void reserveFor(const StepBudget& budget);
  void endAnswering();

  // Made ahead for who sets a deadline, about five megabytes: trees, planes, convex shapes, triangles, fields,
  // terrains.
  static constexpr PairCounts kReserved{256, 128, 32, 32, 32, 128};

  StepState step_;
  StepCarryOver carryOver_{step_};
  StepAnswers answers_{step_};
  StepRefinement refinement_{step_, carryOver_, answers_};
  NonFinitePairs nonFinite_;
  OpenStepAnswers open_{step_, refinement_, carryOver_, nonFinite_};
  std::mutex mutex_;  // guards pool and lists of pairs while algorithms run
  PairPool pool_;
  AskedPairs asked_;
  std::atomic<std::uint32_t> culledPairs_{0};
  const bool hasThreads_;  // Bullet's own pairs are answered by several
  bool isRetired_ = false;
  bool isCollecting_ = false;
  bool isAnswering_ = false;  // users' callbacks may be called
  std::optional<PairCounts> nextRoom_;
  bool hasRoomForDeadlines_ = false;
  const btOverlappingPairCache* worldPairs_ = nullptr;  // only compared: the last that had pairs and was no ghost's
  StepClock clock_;
  std::optional<WorldHook> hook_;
  std::optional<Registration> registration_;  // last: algorithms may be made as soon as it stands
};

}  // namespace cairn::bullet
