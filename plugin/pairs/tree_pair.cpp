// SPDX-License-Identifier: Zlib
#include "pairs/tree_pair.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "counterparts/distance_field.h"
#include "pairs/body_motion.h"
#include "placement/bullet_math.h"
#include "placement/tree_pose.h"

namespace cairn::bullet {

namespace {

// How much farther than its speed explains a body may move in a step by itself, of the smaller one's size.
constexpr float kOwnMotionFraction = 0.25F;
// Of a counterpart, about as much as the largest of those a heap has.
constexpr std::size_t kCounterpartBytes = 768;

std::uint64_t broadphaseId(const btCollisionObjectWrapper& body) {
  const btBroadphaseProxy* proxy = body.getCollisionObject()->getBroadphaseHandle();
  return proxy ? static_cast<std::uint32_t>(proxy->getUid()) : 0;
}

const btStaticPlaneShape* asPlane(const btCollisionShape& shape) {
  return shape.getShapeType() == STATIC_PLANE_PROXYTYPE ? static_cast<const btStaticPlaneShape*>(&shape) : nullptr;
}

// 0 for what is no field.
std::uint64_t fieldMark(const btCollisionShape& shape) {
  const btSdfCollisionShape* const sdf = asField(shape);
  if (!sdf) return 0;
  DistanceField field;
  field.take(*sdf);
  return field.mark();
}

}  // namespace

RelativePlacement TreePair::relativePlacement(const SphereTreeShape& shape, const btTransform& tree,
                                              const btTransform& other) {
  RelativePlacement placement;
  placement.treeInOther.setBasis(other.getBasis().transposeTimes(tree.getBasis()));
  placement.treeInOther.setOrigin((tree.getOrigin() - other.getOrigin()) * other.getBasis());
  shape.getBoundingSphere(placement.center, placement.radius);
  return placement;
}

void TreePair::reset() {
  contacts_.reset();
  counterpart_->reset();
  wasDone_ = true;
  mayHavePoints_ = false;
  saidContacts_ = saidManifolds_ = 0;
  subject_ = {};
  promised_ = {};
  ahead_ = {};
  isFast_ = false;
  isOfCompound_ = false;
  roots_.reset();
  forgetWaiting();
  id_ = kUnnamed;
  collectedAt_ = kNotCollected;
  knownAt_ = kUnknown;
  answeredIn_ = 0;
  lastReport_ = {};
}

bool TreePair::settleApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                           bool alsoFromGround, const Outlook& outlook) {
  const float fast = fastTravel(body0, body1, outlook.sweptTime);
  const float travel = std::max(fast, wallTravel(body0, body1, outlook.wallTime));
  isFast_ = fast > 0 || (sweep_ && sweep_->isAnchored());
  isBroken_ = false;
  if (!stillApart(body0, body1, outlook.asksTriangles, travel)) {
    if (settleBroken(body0, body1)) return true;
    const std::optional<RootSpheres> roots = rootSpheres(body0, body1);
    if ((!roots && !alsoFromGround) || !areRootsApart(body0, body1, roots, btScalar(travel))) {
      roots_ = roots;
      return false;
    }
    const SphereTreeShape* const first = asSphereTree(body0.getCollisionShape());
    treeIsBody0_ = first != nullptr;
    const btCollisionObjectWrapper &treeBody = first ? body0 : body1, &otherBody = first ? body1 : body0;
    rememberBody(treeBody);
    adopt(asSphereTree(treeBody.getCollisionShape()), *otherBody.getCollisionShape());
    forgetWaiting();
    contacts_.settleApart(toVec3(treeBody.getCollisionObject()->getWorldTransform().getOrigin() -
                                 otherBody.getCollisionObject()->getWorldTransform().getOrigin()));
  }
  clearManifolds();  // a guard may have been left
  isSettled_.store(true, std::memory_order_relaxed);
  return true;
}

void TreePair::forgetWaiting() {
  isPlaced_ = isHeld_ = false;
  waited_ = heldError_ = 0;
  moved_ = untold_ = unseenWay_ = 0;
  wholeAt_ = -1;
  spent_ = fullOperations_ = 0;
  wasAhead_ = areGuardsLoaded_ = false;
  if (sweep_) sweep_->forget();
}

bool TreePair::stillApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                          bool asksTriangles, float travel) const {
  if (!subject_.tree || !contacts_.mayBeApart(speculative_ + travel)) return false;
  const btCollisionObjectWrapper& treeBody = treeIsBody0_ ? body0 : body1;
  const btCollisionObjectWrapper& otherBody = treeIsBody0_ ? body1 : body0;
  const SphereTreeShape* const tree = asSphereTree(treeBody.getCollisionShape());
  const btCollisionShape& other = *otherBody.getCollisionShape();
  if (!tree || !isSubject(*tree, asSphereTree(&other), other)) return false;
  return contacts_.stillApart(relativePlacement(*tree, treeBody.getWorldTransform(), otherBody.getWorldTransform()),
                              speculative_ + travel, asksTriangles);
}

bool TreePair::collect(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  isBegun_ = isHoldingStill_ = isSurveyed_ = false;
  isSettled_.store(false, std::memory_order_relaxed);
  rememberBody(asSphereTree(body0.getCollisionShape()) ? body0 : body1);
  return bodies_[0].take(body0) && bodies_[1].take(body1);
}

void TreePair::rememberBody(const btCollisionObjectWrapper& tree) {
  treeObject_.store(tree.getCollisionObject(), std::memory_order_relaxed);
  treeShape_.store(tree.getCollisionShape(), std::memory_order_relaxed);
}

PairKey TreePair::key(std::size_t arrival) const {
  const std::uint64_t uid0 = broadphaseId(body0()), uid1 = broadphaseId(body1());
  return {uid0 << 32 | uid1, std::uint64_t{childPath(body0())} << 32 | childPath(body1()), arrival};
}

bool TreePair::begin(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                     const Outlook& outlook, btScalar threshold, Remeasured remeasured, Budget& budget,
                     ContactScratch& scratch) {
  promised_ = {};  // of a step that an exception ended
  const SphereTreeShape* first = asSphereTree(body0.getCollisionShape());
  treeIsBody0_ = first != nullptr;
  const btCollisionObjectWrapper& treeBody = treeIsBody0_ ? body0 : body1;
  const btCollisionObjectWrapper& otherBody = treeIsBody0_ ? body1 : body0;
  if (!adopt(first ? first : asSphereTree(body1.getCollisionShape()), *otherBody.getCollisionShape())) return false;
  objects_[0] = body0.getCollisionObject();
  objects_[1] = body1.getCollisionObject();
  untold_ = isHeld_ ? 0 : moved_;
  if (isHeld_) tellOfWaiting(treeBody, otherBody);
  isFast_ = fastTravel(treeBody, otherBody, outlook.sweptTime) > 0;
  const auto ahead = btScalar(isFast_ ? 0 : wallTravel(treeBody, otherBody, outlook.wallTime));
  PairPlacement placement = place(treeBody, otherBody, std::max(threshold, ahead));
  const btScalar timeStep = outlook.timeStep;
  setMotion(*placement.treeShape, treeBody, otherBody, timeStep);
  placement.travel = closingSpeed_ * static_cast<float>(timeStep);
  const bool isMeshOnTree = kind_ == CounterpartKind::triangles && !treeIsSmaller_;
  placement.slip = isMeshOnTree ? speedIn(treeBody, otherBody) * static_cast<float>(timeStep) : placement.travel;
  noticeSetDown(motion_.placement, treeBody, otherBody, timeStep);
  isPlaced_ = isBegun_ = true;
  moved_ = unseenWay_ = 0;
  counterpart_->place(placement);
  lookAhead(placement, treeBody, otherBody, outlook.sweptTime, budget);
  const PairContacts::Beginning beginning{remeasured, saysItsLast()};
  if (contacts_.begin(*counterpart_, motion_, beginning, budget, scratch)) spent_ = 0;
  return true;
}

void TreePair::lookAhead(const PairPlacement& placement, const btCollisionObjectWrapper& treeBody,
                         const btCollisionObjectWrapper& otherBody, btScalar sweptTime, Budget& budget) {
  ahead_ = {};
  const bool isAnchored = sweep_ && sweep_->isAnchored();
  if (!isFast_ && !isAnchored) return;
  if (!sweep_) sweep_ = std::make_unique<Sweep>(kind_);
  ahead_ = sweep_->run({placement.treeShape, placement.otherShape, Course(treeBody, sweptTime),
                        Course(otherBody, sweptTime), origin_, placement.reach, isFast_, placement.otherIndex},
                       budget);
}

void TreePair::tellOfWaiting(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody) {
  const SphereTreeShape& tree = *asSphereTree(treeBody.getCollisionShape());
  const RelativePlacement now = relativePlacement(tree, treeBody.getWorldTransform(), otherBody.getWorldTransform());
  const auto moved = static_cast<float>(now.displacementSince(motion_.placement));
  contacts_.waited(moved);
  heldError_ += double(moved / smallerSize_);
  isHeld_ = false;
}

bool TreePair::adopt(const SphereTreeShape* tree, const btCollisionShape& other) {
  const std::optional<CounterpartKind> kind = tree ? kindOf(other) : std::nullopt;
  if (!kind) {
    forget();
    return false;
  }
  const SphereTreeShape* const otherTree = asSphereTree(&other);
  if (isSubject(*tree, otherTree, other)) return true;
  if (subject_.tree) forget();  // else there is nothing to forget, and much to write
  if (*kind != kind_) {
    kind_ = *kind;
    sweep_.reset();
    counterpart_ = makeCounterpart(kind_);
  }
  subject_ = {tree->sharedTree(),
              otherTree ? otherTree->sharedTree() : nullptr,
              tree->scale(),
              otherTree ? otherTree->scale() : 0,
              tree->getMargin(),
              otherTree ? otherTree->getMargin() : 0,
              tree->bodyFrame(),
              otherTree ? otherTree->bodyFrame() : BodyFrame{},
              &other};
  if (const btStaticPlaneShape* const plane = asPlane(other)) {
    subject_.planeNormal = plane->getPlaneNormal();
    subject_.planeConstant = plane->getPlaneConstant();
  }
  subject_.fieldMark = fieldMark(other);
  return true;
}

bool TreePair::isSubject(const SphereTreeShape& tree, const SphereTreeShape* otherTree,
                         const btCollisionShape& other) const {
  if (subject_.tree.get() != &tree.tree() || subject_.treeScale != tree.scale() ||
      subject_.treeMargin != tree.getMargin() || subject_.treeFrame != tree.bodyFrame() ||
      subject_.otherShape != &other)
    return false;
  if (const btStaticPlaneShape* const plane = asPlane(other))
    return !subject_.otherTree && subject_.planeNormal == plane->getPlaneNormal() &&
           subject_.planeConstant == plane->getPlaneConstant();
  if (!otherTree) return !subject_.otherTree && subject_.fieldMark == fieldMark(other);
  return subject_.otherTree.get() == &otherTree->tree() && subject_.otherScale == otherTree->scale() &&
         subject_.otherMargin == otherTree->getMargin() && subject_.otherFrame == otherTree->bodyFrame();
}

void TreePair::forget() {
  contacts_.reset();
  forgetWaiting();
  counterpart_->reset();
  wasDone_ = true;
  subject_ = {};
  clearManifolds();
}

// They stay, empty: Bullet's islands and the user's callbacks see a contact that ended.
void TreePair::clearManifolds() {
  if (!mayHavePoints_) return;
  mayHavePoints_ = false;
  saidContacts_ = saidManifolds_ = 0;
  for (btPersistentManifold* m : manifolds_)
    if (m && m->getNumContacts() > 0) m->clearManifold();
}

PairPlacement TreePair::place(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                              btScalar threshold) {
  const SphereTreeShape* const shape = asSphereTree(treeBody.getCollisionShape());
  origin_ = treeBody.getWorldTransform().getOrigin();
  PairPlacement placement;
  placement.treeShape = shape;
  placement.treeBody = btTransform(treeBody.getWorldTransform().getBasis());
  placement.tree = PlacedTree(shape->tree(), treePose(*shape, placement.treeBody));
  placement.treeMargin = static_cast<float>(shape->getMargin());
  placement.otherShape = otherBody.getCollisionShape();
  placement.other = otherBody.getWorldTransform();
  placement.other.getOrigin() -= origin_;
  placement.otherIndex = otherBody.m_index;
  setSizes(*shape, *placement.otherShape, threshold);
  placement.reach = reach_;
  placement.ownReach = speculative_;
  center_ = smallerCenter(placement);
  return placement;
}

// A point has no size to speak of.
void TreePair::setSizes(const SphereTreeShape& tree, const btCollisionShape& other, btScalar threshold) {
  const float treeSize = static_cast<float>(tree.size());
  const float otherSize = counterpart_->size(other);
  smallerSize_ = otherSize > 0 ? std::min(treeSize, otherSize) : treeSize;
  speculative_ = static_cast<float>(kSpeculativeFraction) * smallerSize_;
  reach_ = speculative_ + static_cast<float>(threshold);
  treeIsSmaller_ = !(otherSize > 0 && otherSize < treeSize);
}

Vec3d TreePair::smallerCenter(const PairPlacement& placement) const {
  const SphereTreeShape* const shape = treeIsSmaller_ ? placement.treeShape : asSphereTree(placement.otherShape);
  const btTransform& body = treeIsSmaller_ ? placement.treeBody : placement.other;
  const Vec3d inPair =
      shape ? treePose(*shape, body) * Vec3d(shape->tree().sphere(kRootNode).center) : toVec3d(body.getOrigin());
  return toVec3d(origin_) + inPair;
}

ScheduledPair TreePair::scheduled() {
  // While there is no answer to speak of, spheres of the whole bodies may have to stand in.
  Traversal& traversal = counterpart_->traversal();
  const bool standsIn = !traversal.done() && !contacts_.hasAnswer(motion_);
  const float unanswered = standsIn ? traversal.pairError({kRootNode, 0}) : 0;
  return {id_, &traversal, center_, smallerSize_, closingSpeed_, reducedMass_, unanswered};
}

float TreePair::speedInOther(const SphereTreeShape& shape, const btCollisionObjectWrapper& tree,
                             const btCollisionObjectWrapper& other) {
  return speedInFrameOf(*other.getCollisionObject(), *tree.getCollisionObject(),
                        static_cast<float>(shape.getAngularMotionDisc()));
}

// What moved farther than its speed explains was set down: how far spheres had overlapped elsewhere, and were allowed
// to, means nothing here.
void TreePair::noticeSetDown(const RelativePlacement& now, const btCollisionObjectWrapper& tree,
                             const btCollisionObjectWrapper& other, btScalar timeStep) {
  const float ownMotion = kOwnMotionFraction * smallerSize_;
  const auto moved = static_cast<float>(now.displacementSince(seenAt_));
  const auto travel = [&] {
    return speedInOther(*asSphereTree(tree.getCollisionShape()), tree, other) * static_cast<float>(timeStep);
  };
  if (isPlaced_ && moved > ownMotion && moved > travel() + ownMotion) {
    contacts_.forgetGuards();
    if (sweep_) sweep_->forget();
  }
  seenAt_ = now;
}

void TreePair::setMotion(const SphereTreeShape& shape, const btCollisionObjectWrapper& treeBody,
                         const btCollisionObjectWrapper& otherBody, btScalar timeStep) {
  setVelocities(treeBody, otherBody, timeStep);
  const btCollisionObject& tree = *treeBody.getCollisionObject();
  const btCollisionObject& other = *otherBody.getCollisionObject();
  const float disc = static_cast<float>(shape.getAngularMotionDisc());
  closingSpeed_ = closingSpeed(tree, other, disc);
  reducedMass_ = reducedMass(tree, other);
  motion_.smallerSize = smallerSize_;
  motion_.reach = reach_;
  motion_.placement = relativePlacement(shape, treeBody.getWorldTransform(), otherBody.getWorldTransform());
}

void TreePair::setVelocities(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                             btScalar timeStep) {
  const btCollisionObject& tree = *treeBody.getCollisionObject();
  const btCollisionObject& other = *otherBody.getCollisionObject();
  motion_.treeLinear = linearVelocity(tree);
  motion_.treeAngular = angularVelocity(tree);
  motion_.treeCenter = toVec3(tree.getWorldTransform().getOrigin() - origin_);
  motion_.otherLinear = linearVelocity(other);
  motion_.otherAngular = angularVelocity(other);
  motion_.otherCenter = toVec3(other.getWorldTransform().getOrigin() - origin_);
  motion_.timeStep = static_cast<float>(timeStep);
}

void TreePair::fetchState() const {
  fetchAhead(this, sizeof(TreePair) - sizeof(bodies_));
  for (const BodySnapshot& body : bodies_) fetchAhead(&body, kCopyBytes);
}

void TreePair::fetchLists() const {
  fetchAhead(counterpart_.get(), kCounterpartBytes);
  contacts_.fetchLists();
  for (const btPersistentManifold* m : manifolds_)
    if (m) fetchAhead(&m->m_companionIdA, sizeof(int));  // how many points it holds is told beside these
}

void TreePair::fetchLeafPairs() const {
  const std::span<const NodePair> pairs = std::as_const(*counterpart_).traversal().leafPairs();
  fetchAhead(pairs.data(), pairs.size_bytes());
  fetchPoints();
}

void TreePair::fetchHeld() const {
  fetchName();
  fetchAhead(&motion_, kHeldBytes);
  for (const BodySnapshot& body : bodies_) fetchAhead(&body, kCopyBytes);
}

void TreePair::fetchHeldBodies() const {
  fetchBody();
  for (const btPersistentManifold* m : manifolds_)
    if (m) fetchAhead(&m->m_companionIdA, sizeof(int));
}

void TreePair::fetchPoints() const {
  for (const btPersistentManifold* m : manifolds_)
    if (m) fetchAhead(m, static_cast<std::size_t>(m->getNumContacts()) * sizeof(btManifoldPoint));
}

void TreePair::appendManifolds(btManifoldArray& manifolds) const {
  for (btPersistentManifold* m : manifolds_)
    if (m) manifolds.push_back(m);
}

void TreePair::releaseManifolds(btDispatcher& dispatcher) {
  for (btPersistentManifold*& m : manifolds_) {
    if (m) dispatcher.releaseManifold(m);
    m = nullptr;
  }
}

}  // namespace cairn::bullet
