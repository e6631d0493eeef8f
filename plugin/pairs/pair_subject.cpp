// SPDX-License-Identifier: Zlib
#include "pairs/pair_subject.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include "colliders/distance_field.h"

namespace cairn::bullet {

namespace {

const btStaticPlaneShape* asPlane(const btCollisionShape& shape) {
  return shape.getShapeType() == STATIC_PLANE_PROXYTYPE ? static_cast<const btStaticPlaneShape*>(&shape) : nullptr;
}

// 0 for a shape that is no distance field.
std::uint64_t fieldFingerprint(const btCollisionShape& shape) {
  const btSdfCollisionShape* const sdf = asField(shape);
  if (!sdf) return 0;
  DistanceField field;
  field.take(*sdf);
  return field.fingerprint();
}

}  // namespace

void PairSubject::take(const SphereTreeShape& tree, const btCollisionShape& other) {
  forget();
  tree_ = tree.sharedTree();
  treeScale_ = tree.scale();
  treeMargin_ = tree.getMargin();
  treeFrame_ = tree.bodyFrame();
  treeContactError_ = tree.maxContactError();
  treeShape_ = &tree;
  otherShape_ = &other;
  if (const SphereTreeShape* const otherTree = asSphereTree(&other)) {
    otherTree_ = otherTree->sharedTree();
    otherScale_ = otherTree->scale();
    otherMargin_ = otherTree->getMargin();
    otherFrame_ = otherTree->bodyFrame();
    otherContactError_ = otherTree->maxContactError();
  }
  if (const btStaticPlaneShape* const plane = asPlane(other)) {
    planeNormal_ = plane->getPlaneNormal();
    planeConstant_ = plane->getPlaneConstant();
  }
  fieldFingerprint_ = fieldFingerprint(other);
}

bool PairSubject::is(const SphereTreeShape& tree, const btCollisionShape& other) const {
  if (tree_.get() != &tree.tree() || !isButForTrees(tree, other)) return false;
  return !otherTree_ || otherTree_.get() == &asSphereTree(&other)->tree();
}

// Another shape may have the same address, but hardly a mesh with as many vertices.
bool PairSubject::isMoved(const SphereTreeShape& tree, const btCollisionShape& other) const {
  const auto isLike = [](const SphereTree& known, const SphereTree& now) {
    return known.vertices().size() == now.vertices().size();
  };
  return treeShape_ == &tree && isButForTrees(tree, other) && isLike(*tree_, tree.tree()) &&
         (!otherTree_ || isLike(*otherTree_, asSphereTree(&other)->tree()));
}

bool PairSubject::isButForTrees(const SphereTreeShape& tree, const btCollisionShape& other) const {
  if (treeScale_ != tree.scale() || treeMargin_ != tree.getMargin() || treeFrame_ != tree.bodyFrame() ||
      treeContactError_ != tree.maxContactError() || otherShape_ != &other)
    return false;
  if (const btStaticPlaneShape* const plane = asPlane(other))
    return !otherTree_ && planeNormal_ == plane->getPlaneNormal() && planeConstant_ == plane->getPlaneConstant();
  const SphereTreeShape* const otherTree = asSphereTree(&other);
  if (!otherTree) return !otherTree_ && fieldFingerprint_ == fieldFingerprint(other);
  return otherTree_ && otherScale_ == otherTree->scale() && otherMargin_ == otherTree->getMargin() &&
         otherFrame_ == otherTree->bodyFrame() && otherContactError_ == otherTree->maxContactError();
}

float PairSubject::rootErrors() const {
  return tree_->error(kRootNode) * static_cast<float>(treeScale_) +
         otherTree_->error(kRootNode) * static_cast<float>(otherScale_);
}

float PairSubject::rootDiameter() const {
  return 2 * tree_->sphere(kRootNode).radius * static_cast<float>(treeScale_);
}

}  // namespace cairn::bullet
