// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/scheduler.h"
#include "dispatch/mesh_time.h"
#include "dispatch/step_answers.h"
#include "dispatch/step_carry_over.h"

namespace cairn::bullet {

/// Updates the pairs of a step within its budget and its plan: begins them, refines them in turns, finishes them.
class StepRefinement final : private TurnListener {
 public:
  StepRefinement(StepState& step, StepCarryOver& carryOver, StepAnswers& answers)
      : step_(step), carryOver_(carryOver), answers_(answers) {}

  /// To be called in this order, after the pairs were ordered. From `beginPairs` on, a user's callback may destroy any
  /// pair that is not finished.
  void planStep();
  void beginPairs();
  void refinePairs();
  void finishBegunPairs();
  /// Learns the cost of updated pairs from all work since `began`.
  void learnUpdates(std::uint64_t operationsBefore, Budget::Clock::time_point began);
  void endStep();

 private:
  PairEstimate estimateOf(std::size_t index);
  void beginPair(std::size_t index);
  void lookCoarsely();
  bool reuses(std::size_t index);
  void finishPair(std::size_t index);
  PairReport finishInTime(TreePair& pair, btManifoldResult& result);
  bool finishResolvedPairs();
  template <class IsAsked>
  bool finishPairs(const IsAsked& isAsked);
  Progress resumePairs();
  Progress serveAlone(std::size_t index);
  void turnEnded(std::size_t index, Progress progress, Budget& budget) override;
  void bookTo(TreePair& pair);

  StepState& step_;
  StepCarryOver& carryOver_;
  StepAnswers& answers_;
  Scheduler scheduler_;
  CostModel cost_;
  // Of all work on an updated pair except its meshes.
  CostModel updateCost_{step_tuning::kUpdateCost, step_tuning::kUpdateWeight};
  MeshTime meshTime_;
  Budget::Clock::duration onMeshes_{};    // in this step
  std::uint64_t operationsOnMeshes_ = 0;  // in this step
  std::uint64_t bookedUntil_ = 0;         // operations of this step that were charged to a pair
  std::uint32_t updated_ = 0;             // pairs begun in this step
  std::uint32_t stepsWithoutTurn_ = 0;
};

}  // namespace cairn::bullet
