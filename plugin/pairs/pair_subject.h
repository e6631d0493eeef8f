// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>
#include <memory>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// The shapes that what a pair knows is about. A body's shape may be replaced between steps, and the old one destroyed;
/// the traversal refers to its tree, and its answer may be kept.
class PairSubject {
 public:
  bool isKnown() const { return tree_ != nullptr; }
  bool is(const SphereTreeShape& tree, const btCollisionShape& other) const;
  void take(const SphereTreeShape& tree, const btCollisionShape& other);
  void forget() { *this = {}; }

  /// How far the root spheres of two trees stand out of their bodies, together; world length. Precondition: both are
  /// trees, and known.
  float rootErrors() const;
  /// Of the tree's root sphere, world length. Precondition: it is known.
  float rootDiameter() const;

 private:
  std::shared_ptr<const SphereTree> tree_, otherTree_;  // the second is null if the other shape is no tree
  btScalar treeScale_ = 0, otherScale_ = 0, treeMargin_ = 0, otherMargin_ = 0;  // the other's if it is a tree
  BodyFrame treeFrame_{}, otherFrame_{};
  const btCollisionShape* otherShape_ = nullptr;  // never followed: it may be gone
  btVector3 planeNormal_{0, 0, 0};                // if it is a plane: another may stand at the same address
  btScalar planeConstant_ = 0;
  std::uint64_t fieldFingerprint_ =
      0;  // if it is a field, which may be given other data: see `DistanceField::fingerprint`
};

}  // namespace cairn::bullet
