// SPDX-License-Identifier: Zlib
#include "dispatch/step_answers.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <utility>

#include "pairs/pair_begin.h"
#include "pairs/pair_carry_over.h"
#include "pairs/pair_write.h"

namespace cairn::bullet {

namespace {

// GImpact's triangles can be locked by one thread only, and users' own shapes may cache results.
bool mayBeAskedByMany(const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case GIMPACT_SHAPE_PROXYTYPE:
    case CUSTOM_CONVEX_SHAPE_TYPE:
    case CUSTOM_POLYHEDRAL_SHAPE_TYPE:
    case CUSTOM_CONCAVE_SHAPE_TYPE:
      return false;
    default:
      return true;
  }
}

}  // namespace

void StepAnswers::takeRules() {
  policy_ = step_.rules.answerPolicy();
  areNew_ = !policy_.mayBeInterrupted;
}

void StepAnswers::answerAll() {
  takeRules();
  clear();
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) add(i);
  run(0, works_.size());
}

// Meshes are asked in this order. First the pairs whose expected cost fits. Then, one after the other, pairs with
// unknown or doubtful cost, because expectations are guesses. Last all others: where nothing is left, meshes may use
// the reservations of leaves.
void StepAnswers::answerBegun() {
  if (works_.empty()) return;
  takeRules();
  for (Work& work : works_) work.share = step_.pairs[work.pair]->work.reserved.operations;
  const std::size_t late = shareOut();
  run(0, late);
  std::size_t last = late;
  for (std::size_t i = late; i < works_.size(); ++i) {
    if (!step_.pairs[works_[i].pair]) continue;
    const std::uint64_t left = step_.left.remaining();
    const std::optional<std::uint64_t> ofMeshes = meshCostOf(works_[i]);
    works_[i].asksMeshes = !ofMeshes;
    if (left == 0 || ofMeshes.value_or(0) > 2 * left) continue;
    std::swap(works_[i], works_[last]);
    works_[last].asksMeshes = true;
    works_[last].share += left;
    run(last, last + 1);
    ++last;
  }
  run(last, works_.size());
}

// Orders pairs without a share for meshes last. Where meshes answer, leaves need not: meshes use the leaves'
// reservation, and more from the rest. The remainder may serve any pair, because something new may have come near.
std::size_t StepAnswers::shareOut() {
  std::uint64_t left = step_.left.remaining();
  std::size_t asking = 0;
  for (Work& work : works_) {
    const std::optional<std::uint64_t> ofMeshes = meshCostOf(work);
    const std::uint64_t more = ofMeshes.value_or(0) - std::min(ofMeshes.value_or(0), work.share);
    work.asksMeshes = ofMeshes && more <= left;
    if (!work.asksMeshes) continue;
    ++asking;
    work.share += more;
    left -= more;
  }
  std::ranges::sort(works_, {}, [](const Work& work) { return std::pair(!work.asksMeshes, work.pair); });
  for (std::size_t i = 0; i < asking; ++i) works_[i].share += left / asking;
  return asking;
}

// Nothing where the cost is unknown.
std::optional<std::uint64_t> StepAnswers::meshCostOf(const Work& work) const {
  const TreePair& pair = *step_.pairs[work.pair];
  if (policy_.finest != Finest::triangles || !pair.isDone()) return 0;
  return pair.collider->expectedMeshCost(pair.motion.relative.placement);
}

// Each pair is finished by one thread while it is in the cache.
void StepAnswers::run(std::size_t first, std::size_t last) {
  workers_.begin();
  const std::size_t together = workers_.count() > 1 ? last - first : 1;
  for (; first < last; first += together)
    runTogether(std::span(works_).subspan(first, std::min(together, last - first)));
}

void StepAnswers::runTogether(std::span<Work> works) {
  workers_.forget();
  for (const Work& work : works)
    if (TreePair* const pair = step_.pairs[work.pair]; pair && pair->isBegun()) cancelReservation(*pair, step_.left);
  workers_.forEach(works.size(), [&](ContactScratch& scratch, std::size_t i) { work(works[i], scratch); });
  for (Work& work : works) write(work);
}

// Users' code must run on the calling thread.
bool StepAnswers::asksForUsersCode(const TreePair& pair) const {
  const PairSides sides = PairSides::of(pair.bodies.body0(), pair.bodies.body1());
  if (!mayBeAskedByMany(sides.otherShape())) return true;
  const SphereTreeShape* const tree = sides.shape();
  return pair.subject.isKnown() && !(tree && pair.subject.is(*tree, sides.otherShape()));  // which is forgotten
}

void StepAnswers::work(Work& work, ContactScratch& scratch) const {
  if (workers_.count() == 1) step_.pairs.prefetchAfter(work.pair);
  const TreePair* const pair = step_.pairs[work.pair];
  if (pair && !pair->isCulled() && !asksForUsersCode(*pair)) measure(work, scratch);
}

// Begins pairs that are not begun, without a budget.
void StepAnswers::measure(Work& work, ContactScratch& scratch) const {
  TreePair& pair = *step_.pairs[work.pair];
  if (areNew_ && policy_.finest == Finest::triangles)
    if (const std::optional<Unmoved> still = unmoved(pair)) {
      work.outcome = Outcome::reused;
      work.still = *still;
      return;
    }
  Budget budget = Budget::operations(work.share);
  if (areNew_) {
    if (!begin(pair, pair.bodies.body0(), pair.bodies.body1(), step_.horizon(), 0, RefreshPolicy::all, budget, scratch))
      return;
    pair.traversal().refine(budget);
  }
  AnswerPolicy policy = policy_;
  if (!work.asksMeshes) policy.finest = Finest::leaves;
  work.answer = bullet::measure(pair, policy, budget, scratch);
  work.operations = budget.used();
  work.outcome = Outcome::measured;
}

// Callbacks may have destroyed pairs meanwhile. Pairs begun before are counted already.
void StepAnswers::write(Work& work) {
  TreePair* const pair = step_.pairs[work.pair];
  if (!pair || pair->isCulled()) return;
  if (work.outcome == Outcome::none) measure(work, workers_.own());
  if (work.outcome != Outcome::none) {
    if (areNew_) ++step_.tally.statistics.pairs;
    const Reported reported = tell(*pair, work);
    step_.count(*pair, reported.report, reported.seen);
  }
  step_.pairs.dismiss(work.pair);
}

// The pair's own callbacks may destroy it while it is written.
StepAnswers::Reported StepAnswers::tell(TreePair& pair, const Work& work) {
  if (work.outcome == Outcome::reused) {
    const PairReport report = reuse(pair, work.still);
    return {report, seen(pair)};
  }
  step_.left.forceCharge(work.operations);
  step_.learnUsual(charge(pair, work.operations));
  const ScheduledPair before = seen(pair);
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  return {bullet::write(pair, work.answer, policy_, step_.dispatcher, result), before};
}

}  // namespace cairn::bullet
