// SPDX-License-Identifier: Zlib
// Pairs that have to wait for a later step: what they said last follows the bodies.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <algorithm>
#include <limits>

#include "contacts/manifold_writer.h"
#include "contacts/reduction.h"
#include "pairs/body_motion.h"
#include "pairs/coarse_ground.h"
#include "pairs/tree_pair.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Expected of any that is not done, at least.
constexpr std::uint64_t kLeastOperations = Scheduler::kTurnOperations;
// Certified error of what nothing is known about, of the smaller body's size.
constexpr double kUnknownError = 1;
// How far bodies may move before points that followed them mean nothing any more, of the smaller one's size.
constexpr float kMostFollowed = 0.04F;
// How far they may come, of the same, in steps that were late for what they say: where it has points, and where it has
// none.
constexpr float kMostUnseen = 0.03F, kMostUnheld = 0.008F;
// Of so many steps in a row in which a pair has no answer that holds, one looks at it however late it is: speeds do not
// tell everything of bodies that are moved by hand. Its name says which, so that not all are looked at in one.
constexpr std::uint64_t kStepsUnseen = 8;
// Seconds that Bullet lets bodies lie still before they want to sleep, unless it was told otherwise (btRigidBody's
// gDeactivationTime, which is not of its collision library). Those that want to earlier were told to by the user.
constexpr btScalar kPatience = 2;

// Bullet's `refreshContactPoints` drops a point whose two sides slide apart. Here it stays, as a plane through the
// point on body 1 that the one on body 0 may not pass: nothing looks for a new one in this step. `turned`: by which
// body 1 has turned since the last. Points farther apart than `farthest` are dropped.
void followBodies(btPersistentManifold& manifold, const btMatrix3x3& turned, btScalar farthest) {
  const btTransform& pose0 = manifold.getBody0()->getWorldTransform();
  const btTransform& pose1 = manifold.getBody1()->getWorldTransform();
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    const btVector3 normal = (turned * point.m_normalWorldOnB).normalized();
    point.m_normalWorldOnB = normal;
    point.m_positionWorldOnA = pose0 * point.m_localPointA;
    point.m_positionWorldOnB = pose1 * point.m_localPointB;
    point.m_distance1 = (point.m_positionWorldOnA - point.m_positionWorldOnB).dot(normal);
    if ((point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) == 0) {
      point.m_positionWorldOnB = point.m_positionWorldOnA - normal * point.m_distance1;
      point.m_localPointB = pose1.invXform(point.m_positionWorldOnB);
    }
    ++point.m_lifeTime;
    if (point.m_distance1 > farthest) manifold.removeContactPoint(i);
  }
}

// How far they would have to move, at least, to have their boxes apart; negative when they are.
float overlapOfBoxes(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  btVector3 lowerA, upperA, lowerB, upperB;
  a.getCollisionShape()->getAabb(a.getWorldTransform(), lowerA, upperA);
  b.getCollisionShape()->getAabb(b.getWorldTransform(), lowerB, upperB);
  btVector3 overlap = upperA;
  overlap.setMin(upperB);
  lowerA.setMax(lowerB);
  overlap -= lowerA;
  return static_cast<float>(overlap[overlap.minAxis()]);
}

}  // namespace

bool TreePair::follow() {
  isBegun_ = isHoldingStill_ = isSurveyed_ = false;
  isSettled_.store(false, std::memory_order_relaxed);
  return bodies_[0].follow() && bodies_[1].follow();
}

void TreePair::survey(std::uint64_t usualOperations, bool isTimed) {
  need_ = isSettled() ? PairNeed() : surveyed(usualOperations, isTimed);
  isSurveyed_ = true;
}

PairNeed TreePair::surveyed(std::uint64_t usualOperations, bool isTimed) {
  const SphereTreeShape* const first = asSphereTree(body0().getCollisionShape());
  const btCollisionObjectWrapper &treeBody = first ? body0() : body1(), &otherBody = first ? body1() : body0();
  const SphereTreeShape* const tree = first ? first : asSphereTree(body1().getCollisionShape());
  const btCollisionShape& other = *otherBody.getCollisionShape();
  treeIsBody0_ = first != nullptr;
  if (!subject_.tree) adopt(tree, other);
  const bool isSame = subject_.tree && tree && isSubject(*tree, asSphereTree(&other), other);
  const bool canStandIn = isSame && hasStandIn(isTimed) && (!isFast_ || kind_ == CounterpartKind::terrain);
  if (!isSame || !isPlaced_) return {kUnknownError * (1 + waited_), usualOperations, canStandIn, true};
  seenNow_ = relativePlacement(*tree, treeBody.getWorldTransform(), otherBody.getWorldTransform());
  moved_ = static_cast<float>(seenNow_.displacementSince(motion_.placement));
  const bool isOld = contacts_.isSilenceOld(moved_, smallerSize_);
  isHoldingStill_ = contacts_.holds(moved_, smallerSize_) && !(saidContacts_ == 0 && isOld);
  // Spheres that stand in for an old answer hold the bodies, and are no reason to wait longer for a new one.
  const bool isUrgent = !isHoldingStill_ || (wholeAt_ >= 0 && isOld);
  const double error = isUrgent ? kUnknownError : heldError_ + double(moved_ / smallerSize_);
  const bool isKept = wasDone_ && contacts_.keepsAt(*counterpart_, seenNow_, motion_.reach);
  const std::uint64_t operations =
      isKept ? contacts_.keptCost(*counterpart_, seenNow_, motion_.reach) : expectedOperations(usualOperations);
  return {error * (1 + waited_), operations, canStandIn || (isHoldingStill_ && !isFast_), !isHoldingStill_ || !wasDone_,
          isKept ? PairContacts::kKeptCostIfFew : operations};
}

// Cheaper than placing it: a body is where its origin is. The size of what is no tree is known once it was placed.
ScheduledPair TreePair::described() const {
  const SphereTreeShape* const first = asSphereTree(body0().getCollisionShape());
  const SphereTreeShape* const tree = first ? first : asSphereTree(body1().getCollisionShape());
  if (!tree) return {.id = id_};
  const btCollisionObjectWrapper &treeBody = first ? body0() : body1(), &otherBody = first ? body1() : body0();
  const SphereTreeShape* const otherTree = asSphereTree(otherBody.getCollisionShape());
  const auto treeSize = static_cast<float>(tree->size());
  const float knownSize = isPlaced_ ? smallerSize_ : treeSize;
  const float size = otherTree ? std::min(treeSize, static_cast<float>(otherTree->size())) : knownSize;
  const btCollisionObject &object = *treeBody.getCollisionObject(), &other = *otherBody.getCollisionObject();
  return {.id = id_,
          .center = toVec3d((size < treeSize ? otherBody : treeBody).getWorldTransform().getOrigin()),
          .size = size,
          .closingSpeed = closingSpeed(object, other, static_cast<float>(tree->getAngularMotionDisc())),
          .mass = reducedMass(object, other)};
}

std::uint64_t TreePair::expectedOperations(std::uint64_t usualOperations) const {
  const std::uint64_t whole = fullOperations_ > 0 ? fullOperations_ : usualOperations;
  return wasDone_ ? whole : std::max(std::max(whole, 2 * spent_) - spent_, kLeastOperations);
}

std::uint64_t TreePair::charged(std::uint64_t operations) {
  spent_ += operations;
  if (!isDone() || contacts_.isKept()) return 0;
  return fullOperations_ = spent_;
}

PairReport TreePair::hold(btDispatcher& dispatcher, btManifoldResult& result, btScalar timeStep, bool isLate) {
  const bool isNew = !isPlaced_;
  if (isNew) beginHeld(timeStep, isLate);
  origin_ = (treeIsBody0_ ? body0() : body1()).getWorldTransform().getOrigin();
  center_ = toVec3d((treeIsBody0_ == treeIsSmaller_ ? body0() : body1()).getWorldTransform().getOrigin());
  isHeld_ = true;
  ++waited_;
  if (isBegun_) wasDone_ = isDone();
  if (isBegun_)
    countStepAsWaited();
  else
    lookForJump(timeStep);
  ahead_ = {};
  const bool needsStandIn = isNew || !isHoldingStill_ || isFast_;  // what was said last says nothing of what is ahead
  const bool isDue = needsStandIn && (id_ + static_cast<std::uint64_t>(waited_)) % kStepsUnseen == 0;
  const bool mayWait = isLate && !isFast_ && !wasAhead_ && !isDue, isFirst = unseenWay_ == 0;
  if (mayWait && mayStay(timeStep)) {
    if (isNew) contacts_.answerAged(2 * kMostFollowed * smallerSize_);  // that they were apart holds no longer
    if (areGuardsLoaded_) stayAwake();
    return reportHeld(needsStandIn);
  }
  // From below the ground everything comes up: for one step its points may follow at any speed.
  const bool standsIn = needsStandIn && !(mayWait && isOnGround() && isFirst);
  if (standsIn || !needsStandIn) unseenWay_ = 0;
  bringPoints(standsIn);
  if (standsIn) standIn(timeStep, dispatcher, result);
  surviveRefresh();
  countSaid();
  if (areGuardsLoaded()) stayAwake();
  return reportHeld(needsStandIn);
}

void TreePair::bringPoints(bool standsIn) {
  forgetImpulsesAhead();
  if (standsIn) chooseForWhole();
  if (standsIn && moved_ > kMostFollowed * smallerSize_) dropFollowed();
  // What stands in on the ground replaces every point: nothing has to follow.
  if (!standsIn || !isOnGround())
    carryPoints(standsIn || contacts_.isAnsweredWithin(moved_, smallerSize_), standsIn);
  else
    axes_ = objects_[1]->getWorldTransform().getBasis();
}

// Of two trees their whole spheres, of trees of like size; on the ground points of the body. Planes are few and soon
// asked: where operations alone are counted, nobody has to wait for them.
bool TreePair::hasStandIn(bool isTimed) const {
  if (kind_ == CounterpartKind::plane) return isTimed;
  return kind_ == CounterpartKind::terrain || (roots_ && roots_->areAlike());
}

// While the bodies hardly move, as far as their speeds tell: what nobody looks at must not get past.
bool TreePair::mayStay(btScalar timeStep) {
  const btCollisionObjectWrapper &tree = treeIsBody0_ ? body0() : body1(), &other = treeIsBody0_ ? body1() : body0();
  unseenWay_ += speedInOther(*asSphereTree(tree.getCollisionShape()), tree, other) * static_cast<float>(timeStep);
  return unseenWay_ <= (mayHavePoints_ ? kMostUnseen : kMostUnheld) * smallerSize_;
}

void TreePair::standIn(btScalar timeStep, btDispatcher& dispatcher, btManifoldResult& result) {
  if (isOnGround()) return standOnGround(timeStep, dispatcher, result);
  std::array<Contact, 1> whole{contacts_.holdWhole(roots_->contact(), smallerSize_)};
  writeStandIn(whole, dispatcher, result);
}

// By what the solver made of them in the last step; new ones may be.
bool TreePair::areGuardsLoaded() {
  areGuardsLoaded_ = false;
  for (const btPersistentManifold* m : manifolds_)
    for (int i = 0; m && i < m->getNumContacts(); ++i) {
      const btManifoldPoint& point = m->getContactPoint(i);
      const bool isGuard = (point.m_contactPointFlags & kGuardFlag) != 0;
      areGuardsLoaded_ = areGuardsLoaded_ || (isGuard && (point.m_appliedImpulse > 0 || point.m_lifeTime == 0));
    }
  return areGuardsLoaded_;
}

// What creeps down behind spheres, an answer at a time, is slow enough for Bullet to put it to sleep where it floats.
// Sensors hold nobody; what the user sends to sleep goes.
void TreePair::stayAwake() const {
  if (!objects_[0]->hasContactResponse() || !objects_[1]->hasContactResponse()) return;
  for (const btCollisionObject* object : objects_) {
    const int state = object->getActivationState();
    const bool isTired = state == WANTS_DEACTIVATION && object->getDeactivationTime() > kPatience;
    if (state == ACTIVE_TAG || isTired) object->activate();
  }
}

// A body that asks for continuous collision is stopped at the ground below those points. Its course is not looked at:
// the next that is looked at cannot go by where it stood before.
void TreePair::standOnGround(btScalar timeStep, btDispatcher& dispatcher, btManifoldResult& result) {
  const btCollisionObjectWrapper &tree = treeIsBody0_ ? body0() : body1(), &ground = treeIsBody0_ ? body1() : body0();
  setVelocities(tree, ground, timeStep);
  const btScalar travel = isFast_ ? btScalar(motion_.greatestSpeed()) * timeStep : btScalar(0);
  CoarseGround coarse(tree, ground, btScalar(speculative_) + travel);
  for (Contact& contact : coarse.contacts())
    if (contact.gap >= speculative_) contact = aheadOf(contact);
  std::ranges::sort(coarse.contacts(), deeper);
  wasAhead_ = std::ranges::any_of(coarse.contacts(), &Contact::isAhead);
  if (sweep_) sweep_->forget();
  dropFollowed();
  writeStandIn(coarse.contacts(), dispatcher, result);
}

// Where its point stops, if it goes on.
Contact TreePair::aheadOf(Contact contact) const {
  contact.isAhead = contact.ofSpheres = true;
  contact.apart = contact.normal * contact.gap;
  contact.position -= contact.normal * (0.5F * contact.gap);
  contact.gap -= motion_.closingSpeed(contact) * motion_.timeStep;
  return contact;
}

void TreePair::lookForJump(btScalar timeStep) {
  const btCollisionObjectWrapper &tree = treeIsBody0_ ? body0() : body1(), &other = treeIsBody0_ ? body1() : body0();
  noticeSetDown(seenNow_, tree, other, timeStep);
}

// Its traversal began here, but what it says is as old as before.
void TreePair::countStepAsWaited() {
  contacts_.answerAged(untold_);
  heldError_ += double(untold_ / smallerSize_);
  untold_ = 0;
}

// Nothing is traversed yet.
void TreePair::beginHeld(btScalar timeStep, bool isLate) {
  const btCollisionObjectWrapper& treeBody = treeIsBody0_ ? body0() : body1();
  const btCollisionObjectWrapper& otherBody = treeIsBody0_ ? body1() : body0();
  const SphereTreeShape& tree = *asSphereTree(treeBody.getCollisionShape());
  adopt(&tree, *otherBody.getCollisionShape());
  objects_[0] = object0();
  objects_[1] = object1();
  setSizes(tree, *otherBody.getCollisionShape(), 0);
  motion_.placement = relativePlacement(tree, treeBody.getWorldTransform(), otherBody.getWorldTransform());
  seenAt_ = seenNow_ = motion_.placement;
  motion_.smallerSize = smallerSize_;
  motion_.reach = reach_;
  isPlaced_ = true;
  moved_ = 0;
  // A step ago it may have been certainly apart, which says nothing of how far it has come since.
  const float travel = speedInOther(tree, treeBody, otherBody) * static_cast<float>(timeStep);
  contacts_.answerAged(travel);
  heldError_ = double(travel / smallerSize_);
  // Boxes deeper in each other than that were so a step ago, too: bodies that were set down there. Boxes take time.
  if (kind_ == CounterpartKind::tree && (isLate || overlapOfBoxes(treeBody, otherBody) > travel))
    heldError_ = std::max(heldError_, standInErrorFraction());
}

// A manifold of its own, if one is free; on the ground, where all others end, the one that says most.
void TreePair::chooseForWhole() {
  if (wholeAt_ >= 0) return;
  const int sign = isOnGround() ? -1 : 1;
  const auto points = [&](const btPersistentManifold* m) { return m ? sign * m->getNumContacts() : 0; };
  wholeAt_ = static_cast<int>(std::ranges::min_element(manifolds_, {}, points) - manifolds_.begin());
}

// Not what the spheres' contact is about to continue: for the user the bodies stay in contact.
void TreePair::dropFollowed() {
  for (int k = 0; k < kMaxClusters; ++k)
    if (btPersistentManifold* const m = manifolds_[static_cast<std::size_t>(k)]; m && k != wholeAt_)
      if (m->getNumContacts() > 0) m->clearManifold();
}

void TreePair::carryPoints(bool dropsParted, bool writesWhole) {
  const btMatrix3x3& axes = objects_[1]->getWorldTransform().getBasis();
  // A turn by nothing, step for step, would add its rounding up.
  const btMatrix3x3 turned = axes == axes_ ? btMatrix3x3::getIdentity() : axes * axes_.transpose();
  for (int k = 0; k < kMaxClusters; ++k) {
    const bool drops = dropsParted && !(writesWhole && k == wholeAt_);
    const btScalar farthest = drops ? breakingThreshold() : std::numeric_limits<btScalar>::max();
    if (btPersistentManifold* const m = manifolds_[static_cast<std::size_t>(k)]) followBodies(*m, turned, farthest);
  }
  axes_ = axes;
}

// Bullet refreshes the points of a compound's children before it asks for new ones, and drops what slid or parted by
// more than the manifold's threshold: nothing would be left to hold.
void TreePair::surviveRefresh() {
  for (btPersistentManifold* m : manifolds_)
    if (m) m->setContactBreakingThreshold(btScalar(kMostFollowed * smallerSize_));
}

void TreePair::writeStandIn(std::span<Contact> contacts, btDispatcher& dispatcher, btManifoldResult& result) {
  if (contacts.empty() && !manifolds_[static_cast<std::size_t>(wholeAt_)]) return;
  btPersistentManifold* const m = manifold(dispatcher, wholeAt_);
  if (!m) return;
  ManifoldWriter writer = writerOf(result);
  const HeldContacts held = writer.held(*m);
  writer.write(*m, contacts, chooseContacts(contacts, held.span(), kSeparationFactor * speculative_, speculative_));
}

void TreePair::countSaid() {
  saidContacts_ = saidManifolds_ = 0;
  for (const btPersistentManifold* m : manifolds_) {
    if (!m || m->getNumContacts() == 0) continue;
    saidContacts_ += static_cast<std::uint32_t>(m->getNumContacts());
    ++saidManifolds_;
  }
}

PairReport TreePair::reportHeld(bool isWhole) const {
  PairReport report;
  report.isUnresolved = true;
  const bool isFollowed = moved_ <= kMostFollowed * smallerSize_;
  if (isFollowed) report.errorFraction = heldError_ + double(moved_ / smallerSize_);
  if (isWhole || saysWhole()) report.errorFraction = std::max(report.errorFraction, standInErrorFraction());
  report.errorFraction += double(unseenWay_ / smallerSize_);
  report.contacts = saidContacts_;
  report.manifolds = saidManifolds_;
  return report;
}

// Also where it is only carried along, until an answer takes its place.
bool TreePair::saysWhole() const {
  if (wholeAt_ < 0) return false;
  const btPersistentManifold* const m = manifolds_[static_cast<std::size_t>(wholeAt_)];
  return m && m->getNumContacts() > 0;
}

// Of spheres, how far they stand out; of points, all of the body may be in the ground beside them.
double TreePair::standInErrorFraction() const {
  const auto scale = static_cast<float>(subject_.treeScale);
  if (isOnGround()) return double(2 * subject_.tree->sphere(kRootNode).radius * scale / smallerSize_);
  const float errors = subject_.tree->error(kRootNode) * scale +
                       subject_.otherTree->error(kRootNode) * static_cast<float>(subject_.otherScale);
  return double(errors / smallerSize_);
}

}  // namespace cairn::bullet
