// SPDX-License-Identifier: Zlib
#include "pairs/pair_hold.h"

#include <algorithm>
#include <array>

#include "pairs/coarse_ground.h"

namespace cairn::bullet {

namespace {

constexpr float kMostFollowed = TreePair::kMostFollowed;
// How far they may come, of the smaller one's size, in steps that were late for what they say: where it has points, and
// where it has none.
constexpr float kMostUnseen = 0.03F, kMostUnheld = 0.008F;
// Of so many steps in a row in which a pair has no answer that holds, one looks at it however late it is: speeds do not
// tell everything of bodies that are moved by hand. Its name says which, so that not all are looked at in one.
constexpr std::uint64_t kStepsUnseen = 8;

// How far they would have to move, at least, to have their boxes apart; negative when they are.
float overlapOfBoxes(const PairSides& sides) {
  btVector3 lowerA, upperA, lowerB, upperB;
  sides.tree.getCollisionShape()->getAabb(sides.tree.getWorldTransform(), lowerA, upperA);
  sides.otherShape().getAabb(sides.other.getWorldTransform(), lowerB, upperB);
  btVector3 overlap = upperA;
  overlap.setMin(upperB);
  lowerA.setMax(lowerB);
  overlap -= lowerA;
  return static_cast<float>(overlap[overlap.minAxis()]);
}

// Of spheres, how far they stand out; of points, all of the body may be in the ground beside them.
double standInErrorFraction(const TreePair& pair) {
  return pair.sizes.fraction(pair.isOnGround() ? pair.subject.rootDiameter() : pair.subject.rootErrors());
}

// Nothing is traversed yet.
void beginHeld(TreePair& pair, const HeldStep& step) {
  const PairSides sides = pair.sides();
  pair.adopt(sides);
  pair.manifolds.setBodies(pair.bodies.object0(), pair.bodies.object1());
  pair.sizes = PairSizes::of(*sides.shape(), pair.counterpart->size(sides.otherShape()), 0);
  RelativeMotion& motion = pair.motion.relative;
  motion.placement = pair.motion.seenAt = pair.motion.seenNow = PairMotion::placementOf(sides);
  motion.smallerSize = pair.sizes.smaller;
  motion.reach = pair.sizes.reach;
  pair.age.isPlaced = true;
  pair.age.moved = 0;
  // A step ago it may have been certainly apart, which says nothing of how far it has come since.
  const float travel = PairMotion::speedInOther(sides) * static_cast<float>(step.timeStep);
  pair.contacts.age().approached(travel, 0);
  pair.age.error = pair.sizes.fraction(travel);
  // Boxes deeper in each other than that were so a step ago, too: bodies that were set down there. Boxes take time.
  if (pair.kind == CounterpartKind::tree && (step.isLate || overlapOfBoxes(sides) > travel))
    pair.age.error = std::max(pair.age.error, standInErrorFraction(pair));
}

// Its traversal began here, but what it says is as old as before.
void countStepAsWaited(TreePair& pair) {
  pair.contacts.age().approached(pair.age.untold, 0);
  pair.age.error += pair.sizes.fraction(pair.age.untold);
  pair.age.untold = 0;
}

// While the bodies hardly move, as far as their speeds tell: what nobody looks at must not get past.
bool mayStay(TreePair& pair, const HeldStep& step) {
  pair.age.unseenWay += PairMotion::speedInOther(pair.sides()) * static_cast<float>(step.timeStep);
  return pair.age.unseenWay <= (pair.said.mayHavePoints ? kMostUnseen : kMostUnheld) * pair.sizes.smaller;
}

void writeStandIn(TreePair& pair, std::span<Contact> contacts, const HeldStep& step) {
  if (contacts.empty() && !pair.manifolds.at(pair.manifolds.standIn())) return;
  btPersistentManifold* const m = pair.manifold(step.dispatcher, pair.manifolds.standIn());
  if (!m) return;
  pair.writerOf(step.result).write(*m, pair.choose(pair.manifolds.standIn(), contacts));
}

// Where its point stops, if it goes on.
Contact aheadOf(const RelativeMotion& motion, Contact contact) {
  contact.isAhead = contact.ofSpheres = true;
  contact.apart = contact.normal * contact.gap;
  contact.position -= contact.normal * (0.5F * contact.gap);
  contact.gap -= motion.closingSpeed(contact) * motion.timeStep;
  return contact;
}

// A body that asks for continuous collision is stopped at the ground below those points. Its course is not looked at:
// the next that is looked at cannot go by where it stood before.
void standOnGround(TreePair& pair, const HeldStep& step) {
  const PairSides sides = pair.sides();
  pair.motion.setVelocities(sides, step.timeStep);
  const RelativeMotion& motion = pair.motion.relative;
  const float speculative = pair.sizes.speculative;
  const btScalar travel = pair.course.isFast ? btScalar(motion.greatestSpeed()) * step.timeStep : btScalar(0);
  CoarseGround coarse(sides.tree, sides.other, btScalar(speculative) + travel);
  for (Contact& contact : coarse.contacts())
    if (contact.gap >= speculative) contact = aheadOf(motion, contact);
  std::ranges::sort(coarse.contacts(), deeper);
  pair.said.wasAhead = std::ranges::any_of(coarse.contacts(), &Contact::isAhead);
  pair.course.forgetAnchor();
  pair.manifolds.clearOthers();
  writeStandIn(pair, coarse.contacts(), step);
}

void standIn(TreePair& pair, const HeldStep& step) {
  if (pair.isOnGround()) return standOnGround(pair, step);
  std::array<Contact, 1> whole{pair.contacts.guards().holdWhole(pair.motion.roots->contact(), pair.sizes.smaller)};
  writeStandIn(pair, whole, step);
}

void bringPoints(TreePair& pair, bool standsIn) {
  const float moved = pair.age.moved, size = pair.sizes.smaller;
  pair.forgetImpulsesAhead();
  // A manifold of its own, if one is free; on the ground, where all others end, the one that says most.
  if (standsIn) pair.manifolds.chooseStandIn(pair.isOnGround());
  if (standsIn && moved > kMostFollowed * size) pair.manifolds.clearOthers();
  // What stands in on the ground replaces every point: nothing has to follow.
  if (standsIn && pair.isOnGround()) return pair.manifolds.noteAxes();
  const bool dropsParted = standsIn || pair.contacts.age().isAnsweredWithin(moved, size);
  pair.manifolds.follow(dropsParted ? std::optional(pair.breakingThreshold()) : std::nullopt, standsIn);
}

// `isWhole`: what was said last does not suffice. Else the stand-in may still be carried along, until an answer takes
// its place.
PairReport reportHeld(const TreePair& pair, bool isWhole) {
  const PairAge& age = pair.age;
  PairReport report;
  report.isUnresolved = true;
  if (age.moved <= kMostFollowed * pair.sizes.smaller)
    report.errorFraction = age.error + pair.sizes.fraction(age.moved);
  if (isWhole || pair.manifolds.saysStandIn())
    report.errorFraction = std::max(report.errorFraction, standInErrorFraction(pair));
  report.errorFraction += pair.sizes.fraction(age.unseenWay);
  report.contacts = pair.said.contacts;
  report.manifolds = pair.said.manifolds;
  return report;
}

}  // namespace

bool isBetterHeld(const TreePair& pair) {
  return !pair.isBegun() || (pair.saysItsLast() && !pair.isDone() && !pair.work.need.outrunsAnswers);
}

ScheduledPair seen(const TreePair& pair) {
  return {.id = pair.notes.id, .center = pair.motion.center, .size = pair.sizes.smaller};
}

PairReport hold(TreePair& pair, const HeldStep& step) {
  PairAge& age = pair.age;
  const bool isNew = !age.isPlaced;
  if (isNew) beginHeld(pair, step);
  pair.motion.follow(pair.sides(), pair.sizes);
  age.isHeld = true;
  ++age.waited;
  if (pair.isBegun()) {
    pair.work.wasDone = pair.isDone();
    countStepAsWaited(pair);
  } else {
    pair.lookForJump(pair.motion.seenNow, pair.sides(), step.timeStep);
  }
  pair.course.ahead = {};
  // What was said last says nothing of what is ahead.
  const bool needsStandIn = isNew || !age.holdsStill || pair.course.isFast;
  const bool isDue = needsStandIn && (pair.notes.id + static_cast<std::uint64_t>(age.waited)) % kStepsUnseen == 0;
  const bool mayWait = step.isLate && !pair.course.isFast && !pair.said.wasAhead && !isDue,
             isFirst = age.unseenWay == 0;
  if (mayWait && mayStay(pair, step)) {
    if (isNew) pair.contacts.age().approached(2 * kMostFollowed * pair.sizes.smaller, 0);  // apart they were, no longer
    if (pair.said.areGuardsLoaded) pair.manifolds.stayAwake();
    return reportHeld(pair, needsStandIn);
  }
  // From below the ground everything comes up: for one step its points may follow at any speed.
  const bool standsIn = needsStandIn && !(mayWait && pair.isOnGround() && isFirst);
  if (standsIn || !needsStandIn) age.unseenWay = 0;
  bringPoints(pair, standsIn);
  if (standsIn) standIn(pair, step);
  pair.surviveRefresh();
  pair.countSaid();
  pair.holdGuards();
  return reportHeld(pair, needsStandIn);
}

}  // namespace cairn::bullet
