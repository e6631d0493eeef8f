// SPDX-License-Identifier: Zlib
#include "dispatch/step_refinement.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>

#include "dispatch/step_tuning.h"
#include "pairs/pair_begin.h"
#include "pairs/pair_carry_over.h"
#include "pairs/pair_estimation.h"
#include "pairs/pair_finish.h"
#include "pairs/pair_reuse.h"

namespace cairn::bullet {

void StepRefinement::planStep() {
  StepPlan& plan = step_.plan;
  StepPairs& pairs = step_.pairs;
  const Priority& priority = step_.rules.priority();
  plan.clear();
  if (!step_.rules.isPlanned()) return;
  for (std::size_t i = 0; i < pairs.size(); ++i) plan.add(estimateOf(i));
  if (priority.hasImportances() && plan.isTooMuchFor(step_.means(), updateCost_))
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (pairs[i] && !pairs[i]->isCulled()) plan.weigh(i, priority.importance(describe(*pairs[i])));
  const bool hasNoTime = step_.rules.limit().microseconds == 0;  // nor the operations that every step gets
  const bool mayServeNone =
      step_.left.hasDeadline() && (hasNoTime || stepsWithoutTurn_ < step_tuning::kMaxStepsWithoutTurn);
  plan.decide(step_.means(), updateCost_, carryOver_.cost(), mayServeNone);
}

// Culled and reused pairs cost nothing.
PairEstimate StepRefinement::estimateOf(std::size_t index) {
  if (!step_.pairs[index] || step_.pairs[index]->isCulled() || reuses(index)) return {};
  TreePair& pair = *step_.pairs[index];
  if (!pair.is(PairStage::estimated)) estimate(pair, step_.usual(), step_.left.hasDeadline(), step_.timeStep);
  return pair.work.estimate;
}

void StepRefinement::beginPairs() {
  updated_ = 0;
  onMeshes_ = {};
  operationsOnMeshes_ = 0;
  bookedUntil_ = step_.left.used();
  if (step_.plan.isScarce()) {
    lookCoarsely();
    for (const std::size_t i : step_.plan.chosen())
      if (step_.pairs[i]) beginPair(i);
    return;
  }
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) {
    step_.pairs.prefetchAfter(i);
    if (step_.pairs[i]) beginPair(i);
  }
}

// A pair with only a coarse look goes on waiting. From then on only pairs that share the rest stay scheduled.
void StepRefinement::lookCoarsely() {
  const std::span<const std::size_t> coarse = step_.plan.coarse();
  for (const std::size_t i : coarse) {
    if (!step_.pairs[i]) continue;
    ++step_.pairs[i]->age.waited;
    beginPair(i);
  }
  scheduler_.shareOut(step_.pairs.scheduled(), coarse, step_.plan.coarseOperations(), step_.left, this);
  for (const std::size_t i : coarse)
    if (!step_.plan.sharesTheRest(i)) step_.pairs.unschedule(i);
}

void StepRefinement::beginPair(std::size_t index) {
  TreePair& pair = *step_.pairs[index];
  // In planned steps, reused pairs were handled before.
  if (pair.isCulled() || (!step_.rules.isPlanned() && reuses(index))) return;
  if (pair.isBegun()) {
    step_.pairs.scheduled()[index] = scheduled(pair);
    return;
  }
  if (!begin(pair, pair.bodies.body0(), pair.bodies.body1(), step_.horizon(), 0, step_.refreshPolicyOf(pair),
             step_.left, step_.scratch))
    return step_.pairs.dismiss(index);
  ++step_.tally.statistics.pairs;
  ++updated_;
  // Without a limit no pair has to wait for a turn.
  if (!step_.rules.mayBeInterrupted()) pair.traversal().refine(step_.left);
  reserve(pair, step_.left, cost_);
  if (pair.isDone() && step_.rules.finishesResolvedAtOnce()) return finishPair(index);
  bookTo(pair);
  step_.pairs.scheduled()[index] = scheduled(pair);
}

bool StepRefinement::reuses(std::size_t index) {
  if (!step_.rules.reusesPairs()) return false;
  TreePair& pair = *step_.pairs[index];
  const std::optional<Unmoved> still = unmoved(pair);
  if (!still) return false;
  ++step_.tally.statistics.pairs;
  const PairReport reused = reuse(pair, *still);
  step_.count(pair, reused, seen(pair));
  step_.pairs.dismiss(index);
  return true;
}

void StepRefinement::bookTo(TreePair& pair) {
  // In an open step a finished traversal is answered later, from another budget.
  const bool isFinishedLater = step_.rules.end() == StepEnd::open && pair.isDone();
  const std::uint64_t later = isFinishedLater ? pair.work.reserved.operations : 0;
  step_.learnUsual(charge(pair, step_.left.used() - bookedUntil_ + later));
  bookedUntil_ = step_.left.used();
}

void StepRefinement::turnEnded(std::size_t index, Progress progress, Budget& budget) {
  TreePair* const pair = step_.pairs[index];
  if (!pair) return;
  reserve(*pair, budget, cost_);
  bookTo(*pair);
  if (progress == Progress::done && step_.rules.finishesResolvedAtOnce()) finishPair(index);
}

void StepRefinement::finishPair(std::size_t index) {
  TreePair& pair = *step_.pairs[index];
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  const ScheduledPair before = scheduled(pair);
  const PairReport report = step_.left.hasDeadline() ? finishInTime(pair, result)
                                                     : finish(pair, step_.dispatcher, result,
                                                              step_.rules.answerPolicy(), step_.left, step_.scratch);
  step_.count(pair, report, before);
  if (step_.pairs[index]) bookTo(pair);
  step_.pairs.dismiss(index);
}

// Meshes are asked where there is time for them. They have no reservation: it would keep other pairs from their leaves.
PairReport StepRefinement::finishInTime(TreePair& pair, btManifoldResult& result) {
  AnswerPolicy policy = step_.rules.answerPolicy();
  const double reserved = pair.work.reserved.nanoseconds;
  const auto expected = pair.collider->expectedMeshCost(pair.motion.relative.placement);
  const bool mayAsk = policy.finest == Finest::triangles && pair.isDone() && expected != 0;
  const bool asks = mayAsk && meshTime_.expected(expected) <= step_.left.nanosecondsFree();
  if (mayAsk && !asks) {
    policy.finest = Finest::leaves;
    meshTime_.wasRefused(expected.has_value());
  }
  const std::uint64_t before = step_.left.used();
  const auto began = Budget::Clock::now();
  const PairReport report = finish(pair, step_.dispatcher, result, policy, step_.left, step_.scratch);
  const std::uint64_t used = step_.left.used() - before;
  onMeshes_ += report.onTriangles;
  if (report.isOfMesh)
    operationsOnMeshes_ += used;
  else
    cost_.finished(reserved, Budget::Clock::now() - began - report.onTriangles);
  if (report.onTriangles.count() > 0) meshTime_.took(expected, report.onTriangles);
  if (!expected && report.isOfMesh) meshTime_.learnFirst(used);
  return report;
}

void StepRefinement::refinePairs() {
  carryOver_.reserve();
  Progress progress = scheduler_.run(step_.pairs.scheduled(), step_.rules.priority(), step_.left, this);
  // Reservations of finished traversals exceed the cost of triangles.
  if (progress != Progress::done && finishResolvedPairs()) progress = resumePairs();
  while (step_.plan.isScarce() && progress == Progress::done) {
    if (!step_.plan.decideOnMore(step_.means(), updateCost_)) break;
    carryOver_.reserve();
    for (const std::size_t i : step_.plan.chosen()) progress = serveAlone(i);
  }
  stepsWithoutTurn_ = step_.plan.servesNone() ? stepsWithoutTurn_ + 1 : 0;
}

Progress StepRefinement::serveAlone(std::size_t index) {
  if (step_.pairs[index]) beginPair(index);
  const bool isToBeRefined = step_.pairs[index] && !step_.pairs[index]->isDone();
  if (!isToBeRefined) return Progress::done;
  return scheduler_.runAlone(step_.pairs.scheduled(), index, step_.left, this);
}

Progress StepRefinement::resumePairs() {
  Progress progress = Progress::done;
  for (std::size_t i = 0; i < step_.pairs.size() && progress == Progress::done; ++i)
    if (step_.pairs[i] && step_.pairs[i]->isBegun())
      progress = scheduler_.runAlone(step_.pairs.scheduled(), i, step_.left, this);
  return progress;
}

// In an open step Bullet asks for pairs one by one.
bool StepRefinement::finishResolvedPairs() {
  if (step_.rules.end() != StepEnd::reported) return false;
  return finishPairs([](const TreePair& pair) { return pair.isDone(); });
}

void StepRefinement::finishBegunPairs() {
  (void)finishPairs([](const TreePair& pair) { return !isBetterCarriedOver(pair); });
}

// One by one under a deadline, because the cost of each pair is learnt.
template <class IsAsked>
bool StepRefinement::finishPairs(const IsAsked& isAsked) {
  bool hasAny = false;
  answers_.clear();
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) {
    const TreePair* const pair = step_.pairs[i];
    if (!pair || !pair->isBegun() || !isAsked(*pair)) continue;
    hasAny = true;
    if (step_.left.hasDeadline())
      finishPair(i);
    else
      answers_.add(i);
  }
  answers_.answerBegun();
  bookedUntil_ = step_.left.used();
  return hasAny;
}

void StepRefinement::learnUpdates(std::uint64_t operationsBefore, Budget::Clock::time_point began) {
  if (!step_.left.hasDeadline() || updated_ == 0) return;
  const std::uint64_t operations = step_.left.used() - operationsBefore - operationsOnMeshes_;
  const double expected = updateCost_.expectedNanoseconds(operations) +
                          static_cast<double>(updated_ - 1) * updateCost_.expectedNanoseconds(0);
  updateCost_.finished(expected, Budget::Clock::now() - began - onMeshes_, updated_);
}

void StepRefinement::endStep() {
  cost_.endStep();
  meshTime_.endStep();
  updateCost_.endStep();
}

}  // namespace cairn::bullet
