// SPDX-License-Identifier: Zlib
#include "dispatch/compound_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

bool hasTree(const btCollisionShape& shape) {
  if (asSphereTree(&shape)) return true;
  if (!shape.isCompound()) return false;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    if (hasTree(*compound.getChildShape(i))) return true;
  return false;
}

CompoundAlgorithm::CompoundAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const CompoundAnswers& answers)
    : btCollisionAlgorithm(info), sharedManifold_(info.m_manifold), answers_(answers) {}

CompoundAlgorithm::~CompoundAlgorithm() {
  forget();
}

void CompoundAlgorithm::forget() {
  if (!answering_) return;
  answering_->~btCollisionAlgorithm();
  m_dispatcher->freeCollisionAlgorithm(answering_);
  answering_ = nullptr;
}

// Grandchildren may change without a new revision of the outermost compound, so all are checked every time.
void CompoundAlgorithm::processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                                         const btDispatcherInfo& info, btManifoldResult* result) {
  const btCollisionShape& shape0 = *body0->getCollisionShape();
  const btCollisionShape& shape1 = *body1->getCollisionShape();
  const bool isWithTree = (shape0.isCompound() && hasTree(shape0)) || (shape1.isCompound() && hasTree(shape1));
  if (isWithTree != isWithTree_) forget();
  if (!answering_) {
    btCollisionAlgorithmConstructionInfo construction(m_dispatcher, 0);
    construction.m_manifold = sharedManifold_;
    btCollisionAlgorithmCreateFunc& create = *(isWithTree ? answers_.withTree : answers_.withoutTree);
    answering_ = create.CreateCollisionAlgorithm(construction, body0, body1);
    isWithTree_ = isWithTree;
  }
  answering_->processCollision(body0, body1, info, result);
}

btScalar CompoundAlgorithm::calculateTimeOfImpact(btCollisionObject* body0, btCollisionObject* body1,
                                                  const btDispatcherInfo& info, btManifoldResult* result) {
  return answering_ ? answering_->calculateTimeOfImpact(body0, body1, info, result) : btScalar(1);
}

void CompoundAlgorithm::getAllContactManifolds(btManifoldArray& manifolds) {
  if (answering_) answering_->getAllContactManifolds(manifolds);
}

}  // namespace cairn::bullet
