// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>
#include <memory>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// The shapes that a pair's knowledge is about. A body's shape may be replaced between steps and destroyed, while the
/// traversal and the cache still refer to its tree.
class PairSubject {
 public:
  bool isKnown() const { return tree_ != nullptr; }
  bool is(const SphereTreeShape& tree, const btCollisionShape& other) const;
  /// Whether it is these shapes as they were but for their vertices: see `SphereTreeShape::setVertices`.
  bool isMoved(const SphereTreeShape& tree, const btCollisionShape& other) const;
  void take(const SphereTreeShape& tree, const btCollisionShape& other);
  void forget() { *this = {}; }

  /// Sum of the certified errors of two trees' root spheres; world length. Precondition: both shapes are trees, and
  /// known.
  float rootErrors() const;
  /// Diameter of the tree's root sphere, world length. Precondition: the tree is known.
  float rootDiameter() const;

 private:
  bool isButForTrees(const SphereTreeShape& tree, const btCollisionShape& other) const;

  std::shared_ptr<const SphereTree> tree_, otherTree_;  // the second is null if the other shape is no tree
  btScalar treeScale_ = 0, otherScale_ = 0, treeMargin_ = 0, otherMargin_ = 0;  // the other's only if it is a tree
  BodyFrame treeFrame_{}, otherFrame_{};
  btScalar treeContactError_ = 0, otherContactError_ = 0;
  // Compared, never read: they may be gone.
  const btCollisionShape *treeShape_ = nullptr, *otherShape_ = nullptr;
  btVector3 planeNormal_{0, 0, 0};  // of a plane: another plane may have the same address
  btScalar planeConstant_ = 0;
  std::uint64_t fieldFingerprint_ =
      0;  // if it is a field, which may be given other data: see `DistanceField::fingerprint`
};

}  // namespace cairn::bullet
