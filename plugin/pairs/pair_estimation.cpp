// SPDX-License-Identifier: Zlib
#include "pairs/pair_estimation.h"

#include <algorithm>

#include "pairs/body_motion.h"
#include "pairs/pair_lock.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Certified error of a pair without any knowledge, as a fraction of the smaller body's size.
constexpr double kUnknownError = 1;

// The fallback of two trees of like size is their root spheres; on the ground it is points of the body. Planes are few
// and cheap: under a budget of operations alone nobody has to wait for them.
bool hasFallback(const TreePair& pair, bool isTimed) {
  if (pair.kind == ColliderKind::plane) return isTimed;
  return pair.kind == ColliderKind::terrain || (pair.motion.roots && pair.motion.roots->areAlike());
}

PairEstimate estimateOf(TreePair& pair, std::uint64_t usualOperations, bool isTimed, btScalar timeStep) {
  pair.treeIsBody0 = asSphereTree(pair.bodies.body0().getCollisionShape()) != nullptr;
  const PairSides sides = pair.sides();
  const SphereTreeShape* const tree = sides.shape();
  if (!pair.subject.isKnown()) pair.adopt(sides);
  const bool isSame = pair.subject.isKnown() && tree && pair.subject.is(*tree, sides.otherShape());
  const bool canBeFallback =
      isSame && hasFallback(pair, isTimed) && (!pair.trajectory.isFast || pair.kind == ColliderKind::terrain);
  PairAge& age = pair.age;
  if (!isSame || !age.isPlaced)
    return {.urgency = kUnknownError * (1 + age.waited),
            .operations = usualOperations,
            .canBeCarriedOver = canBeFallback,
            .mayBeCut = true,
            .isUnanswered = !pair.isOnGround()};
  pair.motion.seenNow = PairMotion::placementOf(sides);
  const float travel = PairMotion::speedInOther(sides) * static_cast<float>(timeStep);
  const RelativeMotion& begun = pair.motion.relative;
  age.moved = static_cast<float>(pair.motion.seenNow.displacementSince(begun.placement));
  const bool isOld = pair.contacts.age().isAbsenceStale(age.moved, pair.sizes.smaller);
  age.repeatsLast = pair.contacts.holds(age.moved, pair.sizes.smaller) && !(pair.reported.contacts == 0 && isOld);
  const bool outrunsAnswers = AnswerAge::isOutrunBy(travel, pair.sizes.smaller);
  lockOrRelease(pair, sides, outrunsAnswers && !age.repeatsLast);
  // Guards hold the bodies in place, but are no reason to wait longer for an answer.
  const bool isUrgent = !age.repeatsLast || (pair.manifolds.hasFallback() && isOld);
  const double error = isUrgent ? kUnknownError : age.error + pair.sizes.fraction(age.moved);
  const bool isCached =
      pair.work.wasDone && pair.contacts.keepsAt(*pair.collider, pair.motion.seenNow, begun.maxSeparation);
  const std::uint64_t operations =
      isCached ? pair.contacts.cachedCost(*pair.collider, pair.motion.seenNow, begun.maxSeparation)
               : pair.work.expected(usualOperations);
  return {.urgency = error * (1 + age.waited),
          .operations = operations,
          .canBeCarriedOver = canBeFallback || (age.repeatsLast && !pair.trajectory.isFast),
          .mayBeCut = !age.repeatsLast || !pair.work.wasDone,
          .isUnanswered = !age.repeatsLast && !pair.isOnGround(),
          .outrunsAnswers = outrunsAnswers,
          .operationsIfScarce = isCached ? PairContacts::kCachedCostIfFew : operations};
}

}  // namespace

void estimate(TreePair& pair, std::uint64_t usualOperations, bool isTimed, btScalar timeStep) {
  pair.work.estimate = pair.isCulled() ? PairEstimate() : estimateOf(pair, usualOperations, isTimed, timeStep);
  if (!pair.isCulled()) pair.enter(PairStage::estimated);
}

// Cheaper than placing the collider: a body counts as being at its origin. The size of a shape that is no tree is known
// once it was placed.
ScheduledPair describe(const TreePair& pair) {
  const PairSides sides = PairSides::of(pair.bodies.body0(), pair.bodies.body1());
  const SphereTreeShape* const tree = sides.shape();
  if (!tree) return {.id = pair.notes.id};
  const SphereTreeShape* const otherTree = sides.otherTree();
  const auto treeSize = static_cast<float>(tree->size());
  const float knownSize = pair.age.isPlaced ? pair.sizes.smaller : treeSize;
  const float size = otherTree ? std::min(treeSize, static_cast<float>(otherTree->size())) : knownSize;
  const btCollisionObject &object = *sides.tree.getCollisionObject(), &other = *sides.other.getCollisionObject();
  return {.id = pair.notes.id,
          .center = toVec3d((size < treeSize ? sides.other : sides.tree).getWorldTransform().getOrigin()),
          .size = size,
          .closingSpeed = closingSpeed(object, other, static_cast<float>(tree->getAngularMotionDisc())),
          .mass = reducedMass(object, other)};
}

}  // namespace cairn::bullet
