// SPDX-License-Identifier: Zlib
#include "pairs/pair_carry_over.h"

#include <algorithm>
#include <array>

#include "pairs/coarse_ground.h"

namespace cairn::bullet {

namespace {

constexpr float kMaxFollowed = TreePair::kMaxFollowed;
// How far they may come, of the smaller one's size, in steps that were late for what they say: where it has points, and
// where it has none.
constexpr float kMaxUnseen = 0.03F, kMaxUnheld = 0.008F;
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
double fallbackErrorFraction(const TreePair& pair) {
  return pair.sizes.fraction(pair.isOnGround() ? pair.subject.rootDiameter() : pair.subject.rootErrors());
}

// Nothing is traversed yet.
void beginCarriedOver(TreePair& pair, const CarryOverStep& step) {
  const PairSides sides = pair.sides();
  pair.adopt(sides);
  pair.manifolds.setBodies(pair.bodies.object0(), pair.bodies.object1());
  pair.sizes = PairSizes::of(*sides.shape(), pair.collider->size(sides.otherShape()), 0);
  RelativeMotion& motion = pair.motion.relative;
  motion.placement = pair.motion.seenAt = pair.motion.seenNow = PairMotion::placementOf(sides);
  motion.smallerSize = pair.sizes.smaller;
  motion.maxSeparation = pair.sizes.maxSeparation;
  pair.age.isPlaced = true;
  pair.age.moved = 0;
  // A step ago it may have been certainly apart, which says nothing of how far it has come since.
  const float travel = PairMotion::speedInOther(sides) * static_cast<float>(step.timeStep);
  pair.contacts.age().approached(travel, 0);
  pair.age.error = pair.sizes.fraction(travel);
  // Boxes deeper in each other than that were so a step ago, too: bodies that were set down there. Boxes take time.
  if (pair.kind == ColliderKind::tree && (step.isLate || overlapOfBoxes(sides) > travel))
    pair.age.error = std::max(pair.age.error, fallbackErrorFraction(pair));
}

// Its traversal began here, but what it says is as old as before.
void countStepAsWaited(TreePair& pair) {
  pair.contacts.age().approached(pair.age.uncounted, 0);
  pair.age.error += pair.sizes.fraction(pair.age.uncounted);
  pair.age.uncounted = 0;
}

// While the bodies hardly move, as far as their speeds tell: what nobody looks at must not get past.
bool mayStay(TreePair& pair, const CarryOverStep& step) {
  pair.age.unseenMotion += PairMotion::speedInOther(pair.sides()) * static_cast<float>(step.timeStep);
  return pair.age.unseenMotion <= (pair.reported.mayHavePoints ? kMaxUnseen : kMaxUnheld) * pair.sizes.smaller;
}

void writeFallback(TreePair& pair, std::span<Contact> contacts, const CarryOverStep& step) {
  if (contacts.empty() && !pair.manifolds.at(pair.manifolds.fallback())) return;
  btPersistentManifold* const m = pair.manifold(step.dispatcher, pair.manifolds.fallback());
  if (!m) return;
  pair.writerOf(step.result).write(*m, pair.choose(pair.manifolds.fallback(), contacts));
}

// Where its point stops, if it goes on.
Contact aheadOf(const RelativeMotion& motion, Contact contact) {
  contact.isSpeculative = contact.ofSpheres = true;
  contact.separationVector = contact.normal * contact.separation;
  contact.position -= contact.normal * (0.5F * contact.separation);
  contact.separation -= motion.closingSpeed(contact) * motion.timeStep;
  return contact;
}

// A body that asks for continuous collision is stopped at the ground below those points. Its course is not looked at:
// the next that is looked at cannot go by where it stood before.
void standOnGround(TreePair& pair, const CarryOverStep& step) {
  const PairSides sides = pair.sides();
  pair.motion.setVelocities(sides, step.timeStep);
  const RelativeMotion& motion = pair.motion.relative;
  const float speculative = pair.sizes.speculative;
  const btScalar travel = pair.trajectory.isFast ? btScalar(motion.greatestSpeed()) * step.timeStep : btScalar(0);
  CoarseGround coarse(sides.tree, sides.other, btScalar(speculative) + travel);
  for (Contact& contact : coarse.contacts())
    if (contact.separation >= speculative) contact = aheadOf(motion, contact);
  std::ranges::sort(coarse.contacts(), deeper);
  pair.reported.wasSpeculative = std::ranges::any_of(coarse.contacts(), &Contact::isSpeculative);
  pair.trajectory.forgetAnchor();
  pair.manifolds.clearOthers();
  writeFallback(pair, coarse.contacts(), step);
}

void fallback(TreePair& pair, const CarryOverStep& step) {
  if (pair.isOnGround()) return standOnGround(pair, step);
  std::array<Contact, 1> whole{pair.contacts.guards().guardByRoot(pair.motion.roots->contact(), pair.sizes.smaller)};
  writeFallback(pair, whole, step);
}

void bringPoints(TreePair& pair, bool standsIn) {
  const float moved = pair.age.moved, size = pair.sizes.smaller;
  pair.forgetSpeculativeImpulses();
  // A manifold of its own, if one is free; on the ground, where all others end, the one that says most.
  if (standsIn) pair.manifolds.chooseFallback(pair.isOnGround());
  if (standsIn && moved > kMaxFollowed * size) pair.manifolds.clearOthers();
  // What stands in on the ground replaces every point: nothing has to follow.
  if (standsIn && pair.isOnGround()) return pair.manifolds.noteAxes();
  const bool dropsParted = standsIn || pair.contacts.age().isAnsweredWithin(moved, size);
  pair.manifolds.follow(dropsParted ? std::optional(pair.breakingThreshold()) : std::nullopt, standsIn);
}

// `isRootContact`: what was said last does not suffice. Else the stand-in may still be carried along, until an answer
// takes its place.
PairReport reportCarriedOver(const TreePair& pair, bool isRootContact) {
  const PairAge& age = pair.age;
  PairReport report;
  report.isUnresolved = true;
  if (age.moved <= kMaxFollowed * pair.sizes.smaller) report.errorFraction = age.error + pair.sizes.fraction(age.moved);
  if (isRootContact || pair.manifolds.reportsFallback())
    report.errorFraction = std::max(report.errorFraction, fallbackErrorFraction(pair));
  report.errorFraction += pair.sizes.fraction(age.unseenMotion);
  report.contacts = pair.reported.contacts;
  report.manifolds = pair.reported.manifolds;
  return report;
}

}  // namespace

bool isBetterCarriedOver(const TreePair& pair) {
  return !pair.isBegun() || (pair.mayRepeatLast() && !pair.isDone() && !pair.work.estimate.outrunsAnswers);
}

ScheduledPair seen(const TreePair& pair) {
  return {.id = pair.notes.id, .center = pair.motion.center, .size = pair.sizes.smaller};
}

PairReport carryOver(TreePair& pair, const CarryOverStep& step) {
  PairAge& age = pair.age;
  const bool isNew = !age.isPlaced;
  if (isNew) beginCarriedOver(pair, step);
  pair.motion.follow(pair.sides(), pair.sizes);
  age.isCarriedOver = true;
  ++age.waited;
  if (pair.isBegun()) {
    pair.work.wasDone = pair.isDone();
    countStepAsWaited(pair);
  } else {
    pair.lookForJump(pair.motion.seenNow, pair.sides(), step.timeStep);
  }
  pair.trajectory.speculative = {};
  // What was said last says nothing of what is ahead.
  const bool needsFallback = isNew || !age.repeatsLast || pair.trajectory.isFast;
  const bool isDue = needsFallback && (pair.notes.id + static_cast<std::uint64_t>(age.waited)) % kStepsUnseen == 0;
  const bool mayWait = step.isLate && !pair.trajectory.isFast && !pair.reported.wasSpeculative && !isDue,
             isFirst = age.unseenMotion == 0;
  if (mayWait && mayStay(pair, step)) {
    if (isNew) pair.contacts.age().approached(2 * kMaxFollowed * pair.sizes.smaller, 0);  // apart they were, no longer
    if (pair.reported.areGuardsLoaded) pair.manifolds.stayAwake();
    return reportCarriedOver(pair, needsFallback);
  }
  // From below the ground everything comes up: for one step its points may follow at any speed.
  const bool standsIn = needsFallback && !(mayWait && pair.isOnGround() && isFirst);
  if (standsIn || !needsFallback) age.unseenMotion = 0;
  bringPoints(pair, standsIn);
  if (standsIn) fallback(pair, step);
  pair.surviveRefresh();
  pair.countReported();
  pair.keepGuardedAwake();
  return reportCarriedOver(pair, needsFallback);
}

}  // namespace cairn::bullet
