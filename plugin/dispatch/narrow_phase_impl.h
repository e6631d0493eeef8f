// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

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

/// The narrow phase of one dispatcher. A step is `beginStep`, then Bullet's own pass, then `endStep`. In the pass every
/// algorithm calls `process`, which answers the pair at once or collects it. Several threads may call `process`,
/// `acquire` and `release`, but only where somebody announces the end of a step.
class NarrowPhase::Impl final : public std::enable_shared_from_this<NarrowPhase::Impl> {
 public:
  Impl(btCollisionDispatcher& dispatcher, StepEnd stepEnd, DispatchThreads threads = DispatchThreads::one);
  /// Ties steps to the world's own pass. Precondition: the dispatcher is the world's.
  void hook(btCollisionWorld& world);
  /// Restores dispatcher and world. Algorithms that remain are answered at once and in full.
  void retire();
  /// Of a retired one that was left behind: leaves a host that lives as it was. True where nothing is left to undo.
  bool undoOn(const btCollisionDispatcher& dispatcher);
  bool undoOn(const btCollisionWorld& world);

  StepRules& rules() { return step_.rules; }
  Status setBudget(const StepBudget& budget);
  Status setFrameBudget(const StepBudget& budget);
  void beginFrame(int steps);
  void setPriority(std::unique_ptr<Priority> priority);
  const StepStatistics& lastStep();
  std::vector<PairAnswered> lastAnswers();
  /// Makes idle pairs until there are as many of each kind as given. Otherwise the first step of a scene would spend
  /// most of its time on memory. Within a step the request is kept for its end.
  void reserve(const PairCounts& pairs);

  void beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info);
  void endStep();

  /// Of which bodies there are algorithms of ours, sorted; children of compounds count as their bodies.
  std::vector<ServedPair> servedPairs();
  TreePair* acquire(ColliderKind kind);
  void release(TreePair* pair);
  /// `mayDefer`: false for query algorithms.
  void process(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
               const btDispatcherInfo& info, btManifoldResult& result, bool mayDefer);

 private:
  bool hostsMayBeGone();
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

  // Made in advance for users with a deadline, about five megabytes.
  static constexpr ExpectedPairs kReserved{
      .trees = 256, .planes = 128, .convexShapes = 32, .triangleMeshes = 32, .distanceFields = 32, .terrains = 128};

  StepState step_;
  StepCarryOver carryOver_{step_};
  StepAnswers answers_{step_};
  StepRefinement refinement_{step_, carryOver_, answers_};
  NonFinitePairs nonFinite_;
  OpenStepAnswers open_{step_, refinement_, carryOver_, nonFinite_};
  std::mutex mutex_;  // protects pool and lists of pairs while algorithms run
  PairPool pool_;
  AskedPairs asked_;
  std::atomic<std::uint32_t> culledPairs_{0};
  const bool hasThreads_;  // several threads answer Bullet's own pairs
  bool isRetired_ = false;
  bool isCollecting_ = false;
  bool isAnswering_ = false;  // users' callbacks may be called
  std::optional<PairCounts> nextRoom_;
  bool hasRoomForDeadlines_ = false;
  const btOverlappingPairCache* worldPairs_ = nullptr;  // only compared: the last cache with pairs that was no ghost's
  StepClock clock_;
  std::optional<WorldHook> hook_;
  std::optional<Registration> registration_;  // last: algorithms may be made as soon as it exists
};

}  // namespace cairn::bullet
