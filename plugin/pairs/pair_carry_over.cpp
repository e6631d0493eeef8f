// SPDX-License-Identifier: Zlib
#include "pairs/pair_carry_over.h"

#include <algorithm>
#include <array>

#include "pairs/coarse_ground.h"

namespace cairn::bullet {

namespace {

constexpr float kMaxFollowed = TreePair::kMaxFollowed;
// Largest motion in steps that were too late for the pair, as a fraction of the smaller body's size: for pairs with
// points, and without.
constexpr float kMaxUnseen = 0.03F, kMaxUnheld = 0.008F;
// A pair without a valid answer is looked at once in this many steps however late it is, because velocities do not
// explain bodies that users move. The pair's name decides in which step, so that not all are looked at in one.
constexpr std::uint64_t kStepsUnseen = 8;

// Motion that would separate the bodies' boxes; negative when they are separated.
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

// Error of a fallback: for guards the certified errors of the root spheres; for points of the body its whole size,
// because all of it may be in the ground beside them.
double fallbackErrorFraction(const TreePair& pair) {
  return pair.sizes.fraction(pair.isOnGround() ? pair.subject.rootDiameter() : pair.subject.rootErrors());
}

// No traversal has begun.
void beginCarriedOver(TreePair& pair, const CarryOverStep& step) {
  const PairSides sides = pair.sides();
  pair.adopt(sides);
  pair.clearManifolds();  // points that are left mean nothing where a surface moved
  pair.manifolds.setBodies(pair.bodies.object0(), pair.bodies.object1());
  pair.sizes = PairSizes::of(*sides.shape(), pair.collider->size(sides.otherShape()), 0, 0);
  RelativeMotion& motion = pair.motion.relative;
  motion.placement = pair.motion.seenAt = pair.motion.seenNow = PairMotion::placementOf(sides);
  motion.smallerSize = pair.sizes.smaller;
  motion.maxSeparation = pair.sizes.maxSeparation;
  motion.reported = pair.sizes.reported;
  pair.age.isPlaced = true;
  pair.age.moved = 0;
  // The pair may have been culled a step ago, so nothing is known of the motion since.
  const float travel = PairMotion::speedInOther(sides) * static_cast<float>(step.timeStep);
  pair.contacts.age().approached(travel, 0);
  pair.age.error = pair.sizes.fraction(travel);
  // Boxes that overlap by more also overlapped a step ago: these bodies were placed there. Computing boxes takes time.
  if (pair.kind == ColliderKind::tree && (step.isLate || overlapOfBoxes(sides) > travel))
    pair.age.error = std::max(pair.age.error, fallbackErrorFraction(pair));
}

// The traversal began at these poses, but the answer is as old as before.
void countStepAsWaited(TreePair& pair) {
  pair.contacts.age().approached(pair.age.uncounted, 0);
  pair.age.error += pair.sizes.fraction(pair.age.uncounted);
  pair.age.uncounted = 0;
}

// Whether the bodies hardly move according to their velocities. Nothing may pass through unnoticed while the pair is
// not looked at.
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

// The place where a speculative contact's point stops.
Contact aheadOf(const RelativeMotion& motion, Contact contact) {
  contact.isSpeculative = contact.ofSpheres = true;
  contact.separationVector = contact.normal * contact.separation;
  contact.position -= contact.normal * (0.5F * contact.separation);
  contact.separation -= motion.closingSpeed(contact) * motion.timeStep;
  return contact;
}

// A body with continuous collision is stopped at the ground below those points. Its trajectory is not looked at, so the
// next sweep cannot start from where it stood before.
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
  PairGuards& guards = pair.contacts.guards();
  std::array<Contact, 2> whole{guards.guardByRoot(pair.motion.roots->contact(), pair.sizes.smaller)};
  whole[1] = PairGuards::oppositeOf(whole[0], pair.sizes.smaller);
  writeFallback(pair, std::span(whole).first(guards.areLocked() ? 2 : 1), step);
}

void bringPoints(TreePair& pair, bool standsIn) {
  const float moved = pair.age.moved, size = pair.sizes.smaller;
  pair.forgetSpeculativeImpulses();
  // Its own manifold, if one is free. On the ground, where all others end, the manifold with most points.
  if (standsIn) pair.manifolds.chooseFallback(pair.isOnGround());
  if (standsIn && moved > kMaxFollowed * size) pair.manifolds.clearOthers();
  // The fallback on the ground replaces every point: no point has to follow.
  if (standsIn && pair.isOnGround()) return pair.manifolds.noteAxes();
  const bool dropsParted = standsIn || pair.contacts.age().isAnsweredWithin(moved, size);
  pair.manifolds.follow(dropsParted ? std::optional(pair.breakingThreshold()) : std::nullopt, standsIn);
}

// `isRootContact`: the last answer does not suffice. Otherwise an existing fallback may be carried along until an
// answer replaces it.
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
  // The last answer excludes no speculative contacts.
  const bool needsFallback = isNew || !age.repeatsLast || pair.trajectory.isFast;
  const bool isDue = needsFallback && (pair.notes.id + static_cast<std::uint64_t>(age.waited)) % kStepsUnseen == 0;
  const bool mayWait = step.isLate && !pair.trajectory.isFast && !pair.reported.wasSpeculative && !isDue,
             isFirst = age.unseenMotion == 0;
  if (mayWait && mayStay(pair, step)) {
    if (isNew)
      pair.contacts.age().approached(2 * kMaxFollowed * pair.sizes.smaller, 0);  // they are no longer separated
    if (pair.reported.areGuardsLoaded) pair.manifolds.stayAwake();
    return reportCarriedOver(pair, needsFallback);
  }
  // Bodies below the ground are pushed up: for one step their points may follow at any speed, because contacts recover.
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
