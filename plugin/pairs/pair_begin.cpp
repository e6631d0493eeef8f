// SPDX-License-Identifier: Zlib
#include "pairs/pair_begin.h"

#include <algorithm>
#include <utility>

#include "pairs/body_motion.h"

namespace cairn::bullet {

namespace {

// The waiting of earlier steps.
void endWaiting(TreePair& pair, const PairSides& sides) {
  const auto moved =
      static_cast<float>(PairMotion::placementOf(sides).displacementSince(pair.motion.relative.placement));
  pair.contacts.age().approached(moved, moved);
  pair.age.error += pair.sizes.fraction(moved);
  pair.age.isHeld = false;
}

void lookAhead(TreePair& pair, const PairPlacement& placement, const PairSides& sides, btScalar sweptTime,
               Budget& budget) {
  PairCourse& course = pair.course;
  course.ahead = {};
  if (!course.isFast && !course.isAnchored()) return;
  if (!course.sweep) course.sweep = std::make_unique<Sweep>(pair.kind);
  course.ahead = course.sweep->run(
      {placement.treeShape, placement.otherShape, Course(sides.tree, sweptTime), Course(sides.other, sweptTime),
       pair.motion.origin, placement.reach, course.isFast, placement.otherIndex},
      budget);
}

PairPlacement place(TreePair& pair, const PairSides& sides, btScalar threshold, btScalar timeStep) {
  pair.sizes = PairSizes::of(*sides.shape(), pair.counterpart->size(sides.otherShape()), threshold);
  PairPlacement placement = pair.motion.place(sides, pair.sizes);
  pair.motion.set(sides, pair.sizes, timeStep);
  const auto seconds = static_cast<float>(timeStep);
  placement.travel = pair.motion.closingSpeed * seconds;
  const bool isMeshOnTree = pair.kind == CounterpartKind::triangles && !pair.sizes.treeIsSmaller;
  placement.slip = isMeshOnTree ? speedIn(sides.tree, sides.other) * seconds : placement.travel;
  return placement;
}

}  // namespace

bool begin(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
           const Outlook& outlook, btScalar threshold, Remeasured remeasured, Budget& budget, ContactScratch& scratch) {
  pair.work.promised = {};  // of a step that an exception ended
  const PairSides sides = PairSides::of(body0, body1);
  pair.treeIsBody0 = &sides.tree == &body0;
  if (!pair.adopt(sides)) return false;
  pair.manifolds.setBodies(body0.getCollisionObject(), body1.getCollisionObject());
  pair.age.untold = pair.age.isHeld ? 0 : pair.age.moved;
  if (pair.age.isHeld) endWaiting(pair, sides);
  pair.course.isFast = fastTravel(sides.tree, sides.other, outlook.sweptTime) > 0;
  const auto ahead = btScalar(pair.course.isFast ? 0 : wallTravel(sides.tree, sides.other, outlook.wallTime));
  const PairPlacement placement = place(pair, sides, std::max(threshold, ahead), outlook.timeStep);
  pair.lookForJump(pair.motion.relative.placement, sides, outlook.timeStep);
  pair.age.isPlaced = true;
  pair.enter(PairStage::begun);
  pair.age.moved = pair.age.unseenWay = 0;
  pair.counterpart->place(placement);
  lookAhead(pair, placement, sides, outlook.sweptTime, budget);
  const PairContacts::Beginning beginning{remeasured, pair.saysItsLast()};
  if (pair.contacts.begin(*pair.counterpart, pair.motion.relative, beginning, budget, scratch)) pair.work.spent = 0;
  return true;
}

ScheduledPair scheduled(TreePair& pair) {
  // While there is no answer to speak of, spheres of the whole bodies may have to stand in.
  Traversal& traversal = pair.traversal();
  const PairMotion& motion = pair.motion;
  const bool standsIn = !traversal.done() && !pair.contacts.hasAnswer(motion.relative);
  const float unanswered = standsIn ? traversal.pairError({kRootNode, 0}) : 0;
  return {pair.notes.id,       &traversal,         motion.center, pair.sizes.smaller,
          motion.closingSpeed, motion.reducedMass, unanswered};
}

std::uint64_t charge(TreePair& pair, std::uint64_t operations) {
  pair.work.spent += operations;
  if (!pair.isDone() || pair.contacts.isKept()) return 0;
  return pair.work.ofLastWhole = pair.work.spent;
}

void promise(TreePair& pair, Budget& budget, const EmissionPace& pace) {
  withdrawPromise(pair, budget);
  Promise& promised = pair.work.promised;
  promised.operations = pair.contacts.measuringCost(*pair.counterpart);
  promised.nanoseconds = pace.expectedNanoseconds(promised.operations + pair.contacts.standInCost(*pair.counterpart));
  budget.promise(promised);
}

void withdrawPromise(TreePair& pair, Budget& budget) {
  budget.redeem(std::exchange(pair.work.promised, {}));
}

}  // namespace cairn::bullet
