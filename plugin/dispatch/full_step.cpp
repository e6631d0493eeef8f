// SPDX-License-Identifier: Zlib
#include "dispatch/full_step.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>

#include "pairs/pair_begin.h"
#include "pairs/pair_carry.h"
#include "pairs/pair_hold.h"
#include "pairs/pair_write.h"

namespace cairn::bullet {

namespace {

// GImpact counts who looks at its triangles, for one thread.
bool mayBeAskedByMany(const btCollisionShape& shape) {
  return shape.getShapeType() != GIMPACT_SHAPE_PROXYTYPE;
}

}  // namespace

// One thread writes a pair while it is in the cache.
void FullStep::answer() {
  workers_.begin();
  const std::size_t pairs = step_.pairs.size(), together = workers_.count() > 1 ? pairs : 1;
  measured_.resize(std::max(measured_.size(), pairs));
  for (std::size_t first = 0; first < pairs; first += together) answer(first, std::min(first + together, pairs));
}

void FullStep::answer(std::size_t first, std::size_t last) {
  workers_.forget();
  for (std::size_t i = first; i < last; ++i) prepare(i);
  workers_.forEach(first, last, [this](ContactScratch& scratch, std::size_t i) {
    if (measured_[i].course == Course::asked) measure(i, scratch);
  });
  for (std::size_t i = first; i < last; ++i) write(i);
}

// What may call the user's code.
void FullStep::prepare(std::size_t index) {
  step_.pairs.fetchAfter(index);
  Measured& measured = measured_[index];
  measured.course = Course::none;
  TreePair* const pair = step_.pairs[index];
  if (!pair || pair->isSettled()) return;
  if (step_.rules.carriesPairsOver())
    if (const std::optional<PairReport> carried = carryOver(*pair)) {
      measured.course = Course::carried;
      measured.carried = *carried;
      return;
    }
  const PairSides sides = PairSides::of(pair->bodies.body0(), pair->bodies.body1());
  if (!pair->adopt(sides)) return step_.pairs.dismiss(index);
  measured.course = Course::asked;
  if (!mayBeAskedByMany(sides.otherShape())) measure(index, workers_.own());
}

void FullStep::measure(std::size_t index, ContactScratch& scratch) {
  TreePair& pair = *step_.pairs[index];
  Measured& measured = measured_[index];
  Budget budget = Budget::unlimited();
  if (!begin(pair, pair.bodies.body0(), pair.bodies.body1(), step_.outlook(), 0, Remeasured::all, budget, scratch))
    return;
  pair.traversal().refine(budget);
  measured.answer = bullet::measure(pair, step_.rules.answerPolicy(), budget, scratch);
  measured.operations = budget.used();
  measured.course = Course::measured;
}

// Callbacks may have destroyed pairs meanwhile.
void FullStep::write(std::size_t index) {
  const Measured& measured = measured_[index];
  TreePair* const pair = step_.pairs[index];
  if (!pair) return;
  if (measured.course == Course::carried) {
    ++step_.tally.statistics.pairs;
    step_.count(measured.carried, seen(*pair));
  } else if (measured.course == Course::measured) {
    ++step_.tally.statistics.pairs;
    step_.left.chargeAnyway(measured.operations);
    step_.learnUsual(charge(*pair, measured.operations));
    const ScheduledPair before = seen(*pair);
    btManifoldResult result(&pair->bodies.body0(), &pair->bodies.body1());
    step_.count(bullet::write(*pair, measured.answer, step_.rules.answerPolicy(), step_.dispatcher, result), before);
  }
  step_.pairs.dismiss(index);
}

}  // namespace cairn::bullet
