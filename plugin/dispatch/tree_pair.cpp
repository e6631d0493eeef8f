// SPDX-License-Identifier: Zlib
#include "dispatch/tree_pair.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "contacts/manifold_writer.h"
#include "shape/bullet_math.h"

namespace cairn::bullet {

namespace {

// A manifold holds points up to the reach; a little more, so that rounding does not refuse one.
constexpr float kBreakingFactor = 1.01F;
// Bullet matches points closer than the breaking threshold: chosen points keep half as much again between them.
constexpr float kSeparationFactor = 1.5F;
// How far a contact may wander in a step, as a fraction of the smaller body's size, and still be the same one.
constexpr float kInheritanceFraction = 0.02F;

std::uint64_t broadphaseId(const btCollisionObjectWrapper& body) {
  const btBroadphaseProxy* proxy = body.getCollisionObject()->getBroadphaseHandle();
  return proxy ? static_cast<std::uint32_t>(proxy->getUid()) : 0;
}

// What is no rigid body (a multibody's link, a ghost) says how it moved, not how it moves.
Vec3 linearVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return toVec3(body ? body->getLinearVelocity() : object.getInterpolationLinearVelocity());
}

Vec3 angularVelocity(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return toVec3(body ? body->getAngularVelocity() : object.getInterpolationAngularVelocity());
}

Pose treePose(const SphereTreeShape& shape, const btTransform& body) {
  const btTransform fromTree = body * shape.bodyFromTree();
  return {toMat3d(fromTree.getBasis()), toVec3d(fromTree.getOrigin()), double(shape.scale())};
}

}  // namespace

void TreePair::reset() {
  contacts_.reset();
  counterpart_->reset();
  subject_ = {};
  id_ = kUnnamed;
  collectedAt_ = kNotCollected;
  knownAt_ = kUnknown;
  answeredIn_ = 0;
}

bool TreePair::collect(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  return bodies_[0].take(body0) && bodies_[1].take(body1);
}

PairKey TreePair::key(std::size_t arrival) const {
  const std::uint64_t uid0 = broadphaseId(body0()), uid1 = broadphaseId(body1());
  return {uid0 << 32 | uid1, std::uint64_t{childPath(body0())} << 32 | childPath(body1()), arrival};
}

bool TreePair::begin(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar timeStep,
                     btScalar threshold, Budget& budget) {
  const SphereTreeShape* first = asSphereTree(body0.getCollisionShape());
  treeIsBody0_ = first != nullptr;
  const btCollisionObjectWrapper& treeBody = treeIsBody0_ ? body0 : body1;
  const btCollisionObjectWrapper& otherBody = treeIsBody0_ ? body1 : body0;
  if (!adopt(first ? first : asSphereTree(body1.getCollisionShape()), *otherBody.getCollisionShape())) return false;
  objects_[0] = body0.getCollisionObject();
  objects_[1] = body1.getCollisionObject();
  place(treeBody, otherBody, threshold);
  setMotion(treeBody, otherBody, timeStep);
  counterpart_->place(placement_);
  contacts_.begin(*counterpart_, motion_, budget);
  return true;
}

bool TreePair::adopt(const SphereTreeShape* tree, const btCollisionShape& other) {
  const std::optional<CounterpartKind> kind = tree ? kindOf(other) : std::nullopt;
  if (!kind) {
    forget();
    return false;
  }
  const SphereTreeShape* const otherTree = asSphereTree(&other);
  Subject now{tree->sharedTree(), otherTree ? otherTree->sharedTree() : nullptr, tree->scale(),
              otherTree ? otherTree->scale() : 0, &other};
  if (now == subject_) return true;
  forget();
  if (*kind != kind_) {
    kind_ = *kind;
    counterpart_ = makeCounterpart(kind_);
  }
  subject_ = std::move(now);
  return true;
}

// The manifolds stay, empty: Bullet's islands and the user's callbacks see a contact that ended.
void TreePair::forget() {
  contacts_.reset();
  counterpart_->reset();
  subject_ = {};
  for (btPersistentManifold* m : manifolds_)
    if (m) m->clearManifold();
}

void TreePair::place(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                     btScalar threshold) {
  const SphereTreeShape* const shape = asSphereTree(treeBody.getCollisionShape());
  origin_ = treeBody.getWorldTransform().getOrigin();
  placement_.treeShape = shape;
  placement_.treeBody = btTransform(treeBody.getWorldTransform().getBasis());
  placement_.tree = PlacedTree(shape->tree(), treePose(*shape, placement_.treeBody));
  placement_.treeMargin = static_cast<float>(shape->getMargin());
  placement_.otherShape = otherBody.getCollisionShape();
  placement_.other = otherBody.getWorldTransform();
  placement_.other.getOrigin() -= origin_;
  const float treeSize = static_cast<float>(shape->size());
  const float otherSize = counterpart_->size(*placement_.otherShape);
  smallerSize_ = otherSize > 0 ? std::min(treeSize, otherSize) : treeSize;  // a point has no size to speak of
  speculative_ = static_cast<float>(kSpeculativeFraction) * smallerSize_;
  placement_.reach = speculative_ + static_cast<float>(threshold);
}

void TreePair::setMotion(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                         btScalar timeStep) {
  const btCollisionObject& tree = *treeBody.getCollisionObject();
  const btCollisionObject& other = *otherBody.getCollisionObject();
  motion_.treeLinear = linearVelocity(tree);
  motion_.treeAngular = angularVelocity(tree);
  motion_.treeCenter = toVec3(tree.getWorldTransform().getOrigin() - origin_);
  motion_.otherLinear = linearVelocity(other);
  motion_.otherAngular = angularVelocity(other);
  motion_.otherCenter = toVec3(other.getWorldTransform().getOrigin() - origin_);
  const float disc = static_cast<float>(placement_.treeShape->getAngularMotionDisc());
  closingSpeed_ =
      length(motion_.treeLinear - motion_.otherLinear) + length(motion_.treeAngular - motion_.otherAngular) * disc;
  motion_.timeStep = static_cast<float>(timeStep);
  motion_.smallerSize = smallerSize_;
  placement_.travel = closingSpeed_ * static_cast<float>(timeStep);
}

// Null only when Bullet's pool is used up and the user forbade it to grow.
btPersistentManifold* TreePair::manifold(btDispatcher& dispatcher, int cluster) {
  btPersistentManifold*& m = manifolds_[static_cast<std::size_t>(cluster)];
  if (!m) m = dispatcher.getNewManifold(objects_[0], objects_[1]);
  if (m) m->setContactBreakingThreshold(btScalar(placement_.reach * kBreakingFactor));
  return m;
}

void TreePair::writeCluster(int k, btDispatcher& dispatcher, btManifoldResult& result, ContactScratch& scratch,
                            PairReport& report) {
  const std::span<Contact> members = scratch.contacts.cluster(k);
  const bool isHeld = manifolds_[static_cast<std::size_t>(k)] != nullptr;
  if (members.empty() && !isHeld) return;
  btPersistentManifold* const m = manifold(dispatcher, k);
  if (!m) return;
  ManifoldWriter writer(result, origin_, treeIsBody0_, kInheritanceFraction * smallerSize_);
  const HeldContacts held = writer.held(*m);
  const ContactChoice choice = chooseContacts(members, held.span(), kSeparationFactor * speculative_, speculative_);
  writer.write(*m, members, choice);

  for (int i = 0; i < choice.count; ++i) {
    const Contact& chosen = members[static_cast<std::size_t>(choice.index[static_cast<std::size_t>(i)])];
    contacts_.remember(chosen);
    const double error = double(counterpart_->traversal().pairError(chosen.pair)) / double(smallerSize_);
    report.errorFraction = std::max(report.errorFraction, error);
  }
  report.contacts += static_cast<std::uint32_t>(choice.count);
  report.manifolds += choice.count > 0 ? 1 : 0;
}

PairReport TreePair::finish(btDispatcher& dispatcher, btManifoldResult& result, Unresolved policy,
                            bool mayBeInterrupted, Budget& budget, ContactScratch& scratch) {
  PairReport report;
  report.isUnresolved = !counterpart_->traversal().done();
  report.errorFraction = double(counterpart_->traversal().worstFrontError()) / double(smallerSize_);
  contacts_.finish(*counterpart_, policy, motion_, placement_.reach, budget, scratch);
  for (int k = 0; k < kMaxClusters; ++k) writeCluster(k, dispatcher, result, scratch, report);
  if (mayBeInterrupted) contacts_.rememberDeepest(scratch);
  return report;
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
