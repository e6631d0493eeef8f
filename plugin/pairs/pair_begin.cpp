// SPDX-License-Identifier: Zlib
#include "pairs/pair_begin.h"

#include <algorithm>
#include <utility>

#include "pairs/body_motion.h"

namespace cairn::bullet {

namespace {

// The waiting time of earlier steps.
void endWaiting(TreePair& pair, const PairSides& sides) {
  const auto moved =
      static_cast<float>(PairMotion::placementOf(sides).displacementSince(pair.motion.relative.placement));
  pair.contacts.age().approached(moved, moved);
  pair.age.error += pair.sizes.fraction(moved);
  pair.age.isCarriedOver = false;
}

void lookAhead(TreePair& pair, const PairPlacement& placement, const PairSides& sides, btScalar sweptTime,
               Budget& budget) {
  PairTrajectory& trajectory = pair.trajectory;
  trajectory.speculative = {};
  if (!trajectory.isFast && !trajectory.isAnchored()) return;
  if (!trajectory.sweep) trajectory.sweep = std::make_unique<Sweep>(makeSweptTarget(pair.kind));
  trajectory.speculative = trajectory.sweep->run(
      {placement.treeShape, placement.otherShape, Trajectory(sides.tree, sweptTime), Trajectory(sides.other, sweptTime),
       pair.motion.origin, placement.maxSeparation, trajectory.isFast, placement.otherIndex},
      budget);
}

PairPlacement place(TreePair& pair, const PairSides& sides, btScalar threshold, float ahead, btScalar timeStep) {
  pair.sizes = PairSizes::of(*sides.shape(), pair.collider->size(sides.otherShape()), threshold, ahead);
  PairPlacement placement = pair.motion.place(sides, pair.sizes);
  pair.motion.set(sides, pair.sizes, timeStep);
  const auto seconds = static_cast<float>(timeStep);
  placement.travel = pair.motion.closingSpeed * seconds;
  const bool isMeshOnTree = pair.kind == ColliderKind::triangles && !pair.sizes.treeIsSmaller;
  placement.slip = isMeshOnTree ? speedIn(sides.tree, sides.other) * seconds : placement.travel;
  return placement;
}

}  // namespace

bool begin(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
           const StepHorizon& horizon, btScalar threshold, RefreshPolicy refresh, Budget& budget,
           ContactScratch& scratch) {
  pair.work.reserved = {};  // left over from a step that an exception ended
  const PairSides sides = PairSides::of(body0, body1);
  pair.treeIsBody0 = &sides.tree == &body0;
  if (!pair.adopt(sides)) return false;
  pair.manifolds.setBodies(body0.getCollisionObject(), body1.getCollisionObject());
  pair.age.uncounted = pair.age.isCarriedOver ? 0 : pair.age.moved;
  if (pair.age.isCarriedOver) endWaiting(pair, sides);
  pair.trajectory.isFast = fastTravel(sides.tree, sides.other, horizon.sweptTime) > 0;
  const float ahead = pair.trajectory.isFast ? 0 : wallTravel(sides.tree, sides.other, horizon.wallTime);
  const PairPlacement placement = place(pair, sides, threshold, ahead, horizon.timeStep);
  pair.lookForJump(pair.motion.relative.placement, sides, horizon.timeStep);
  pair.age.isPlaced = true;
  pair.enter(PairStage::begun);
  pair.age.moved = pair.age.unseenMotion = 0;
  pair.collider->place(placement);
  lookAhead(pair, placement, sides, horizon.sweptTime, budget);
  const PairContacts::Beginning beginning{refresh, pair.mayRepeatLast()};
  if (pair.contacts.begin(*pair.collider, pair.motion.relative, beginning, budget, scratch)) pair.work.spent = 0;
  return true;
}

ScheduledPair scheduled(TreePair& pair) {
  // Without an answer, guards of the root spheres may be needed.
  Traversal& traversal = pair.traversal();
  const PairMotion& motion = pair.motion;
  const bool standsIn = !traversal.done() && !pair.contacts.hasAnswer(motion.relative);
  const float unanswered = standsIn ? traversal.pairError({kRootNode, 0}) : 0;
  return {pair.notes.id,       &traversal,         motion.center, pair.sizes.smaller,
          motion.closingSpeed, motion.reducedMass, unanswered};
}

std::uint64_t charge(TreePair& pair, std::uint64_t operations) {
  pair.work.spent += operations;
  if (!pair.isDone() || pair.contacts.isCached()) return 0;
  return pair.work.ofLastComplete = pair.work.spent;
}

void reserve(TreePair& pair, Budget& budget, const CostModel& cost) {
  cancelReservation(pair, budget);
  Reservation& reserved = pair.work.reserved;
  reserved.operations = pair.contacts.measuringCost(*pair.collider);
  reserved.nanoseconds = cost.expectedNanoseconds(reserved.operations + pair.contacts.fallbackCost(*pair.collider));
  budget.reserve(reserved);
}

void cancelReservation(TreePair& pair, Budget& budget) {
  budget.release(std::exchange(pair.work.reserved, {}));
}

}  // namespace cairn::bullet
