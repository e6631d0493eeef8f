// SPDX-License-Identifier: Zlib
#include "dispatch/step_answers.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "pairs/pair_begin.h"
#include "pairs/pair_hold.h"
#include "pairs/pair_write.h"

namespace cairn::bullet {

namespace {

// GImpact counts who looks at its triangles, for one thread.
bool mayBeAskedByMany(const btCollisionShape& shape) {
  return shape.getShapeType() != GIMPACT_SHAPE_PROXYTYPE;
}

}  // namespace

void StepAnswers::answerAll() {
  clear();
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) add(i);
  run(0, works_.size());
}

// First all that what meshes are expected to take is enough for. Then, one after the other, those for whom it is not
// known, or may yet do: what is expected is a guess. Last those for whom it is too much.
void StepAnswers::answerBegun() {
  for (Work& work : works_) work.share = step_.pairs[work.pair]->work.promised.operations;
  const std::size_t late = shareOut();
  run(0, late);
  std::size_t last = late;
  for (std::size_t i = late; i < works_.size(); ++i) {
    if (!step_.pairs[works_[i].pair] || meshCostOf(works_[i]).value_or(0) > 2 * step_.left.remaining()) continue;
    std::swap(works_[i], works_[last]);
    works_[last].asksMeshes = true;
    works_[last].share += step_.left.remaining();
    run(last, last + 1);
    ++last;
  }
  run(last, works_.size());
}

// Puts those that get nothing for meshes last, and returns the first of them. What is left may serve any: something new
// may have come near.
std::size_t StepAnswers::shareOut() {
  std::uint64_t left = step_.left.remaining();
  for (Work& work : works_) {
    const std::optional<std::uint64_t> ofMeshes = meshCostOf(work);
    const std::uint64_t extra = ofMeshes.value_or(0) - std::min(ofMeshes.value_or(0), work.share);
    work.asksMeshes = ofMeshes && extra <= left;
    if (!work.asksMeshes) continue;
    work.share += extra;
    left -= extra;
  }
  const std::size_t late =
      works_.size() - std::ranges::stable_partition(works_, std::identity(), &Work::asksMeshes).size();
  for (std::size_t i = 0; i < late; ++i) works_[i].share += left / late;
  return late;
}

// Nothing where that is not known.
std::optional<std::uint64_t> StepAnswers::meshCostOf(const Work& work) const {
  const TreePair& pair = *step_.pairs[work.pair];
  if (!step_.rules.asksTriangles() || !pair.isDone()) return 0;
  return pair.counterpart->expectedMeshCost(pair.motion.relative.placement);
}

// One thread writes a pair while it is in the cache.
void StepAnswers::run(std::size_t first, std::size_t last) {
  workers_.begin();
  const std::size_t together = workers_.count() > 1 ? last - first : 1;
  for (; first < last; first += together)
    runTogether(std::span(works_).subspan(first, std::min(together, last - first)));
}

void StepAnswers::runTogether(std::span<Work> works) {
  workers_.forget();
  for (const Work& work : works)
    if (TreePair* const pair = step_.pairs[work.pair]; pair && pair->isBegun()) withdrawPromise(*pair, step_.left);
  workers_.forEach(0, works.size(), [&](ContactScratch& scratch, std::size_t i) { work(works[i], scratch); });
  for (Work& work : works) write(work);
}

// That is for the calling thread.
bool StepAnswers::asksForUsersCode(const TreePair& pair) const {
  const PairSides sides = PairSides::of(pair.bodies.body0(), pair.bodies.body1());
  const SphereTreeShape* const tree = sides.shape();
  const bool forgets = pair.subject.isKnown() && !(tree && pair.subject.is(*tree, sides.otherShape()));
  return forgets || !mayBeAskedByMany(sides.otherShape());
}

// What is not begun is so from the beginning, without a budget.
void StepAnswers::work(Work& work, ContactScratch& scratch) const {
  if (workers_.count() == 1) step_.pairs.fetchAfter(work.pair);
  const TreePair* const pair = step_.pairs[work.pair];
  if (!pair || pair->isSettled()) return;
  if (!pair->isBegun() && step_.rules.carriesPairsOver())
    if (const std::optional<StandsStill> still = standsStill(*pair)) {
      work.course = Course::carried;
      work.still = *still;
      return;
    }
  if (!asksForUsersCode(*pair)) measure(work, scratch);
}

void StepAnswers::measure(Work& work, ContactScratch& scratch) const {
  TreePair& pair = *step_.pairs[work.pair];
  Budget budget = Budget::operations(work.share);
  if (!pair.isBegun()) {
    if (!begin(pair, pair.bodies.body0(), pair.bodies.body1(), step_.outlook(), 0, Remeasured::all, budget, scratch))
      return;
    pair.traversal().refine(budget);
  }
  AnswerPolicy policy = step_.rules.answerPolicy();
  if (!work.asksMeshes) policy.finest = Finest::leaves;
  work.answer = bullet::measure(pair, policy, budget, scratch);
  work.operations = budget.used();
  work.course = Course::measured;
}

// Callbacks may have destroyed pairs meanwhile. Those begun before are counted already.
void StepAnswers::write(Work& work) {
  if (!step_.pairs[work.pair] || step_.pairs[work.pair]->isSettled()) return;
  if (work.course == Course::asked) measure(work, workers_.own());
  TreePair* const pair = step_.pairs[work.pair];
  if (pair && work.course != Course::asked) {
    if (!step_.rules.mayBeInterrupted()) ++step_.tally.statistics.pairs;
    const ScheduledPair before = seen(*pair);
    step_.count(tell(*pair, work), before);
  }
  step_.pairs.dismiss(work.pair);
}

PairReport StepAnswers::tell(TreePair& pair, const Work& work) {
  if (work.course == Course::carried) return carryOver(pair, work.still);
  step_.left.chargeAnyway(work.operations);
  step_.learnUsual(charge(pair, work.operations));
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  return bullet::write(pair, work.answer, step_.rules.answerPolicy(), step_.dispatcher, result);
}

}  // namespace cairn::bullet
