// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// The two bodies of a pair: the one with the sphere-tree, and the other.
struct PairSides {
  const btCollisionObjectWrapper &tree, &other;

  static PairSides of(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, bool treeIsBody0) {
    return treeIsBody0 ? PairSides{body0, body1} : PairSides{body1, body0};
  }
  /// Of two trees, body 0's is the tree. Where neither body is a tree, `shape` is null.
  static PairSides of(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
    return of(body0, body1, asSphereTree(body0.getCollisionShape()) != nullptr);
  }

  const SphereTreeShape* shape() const { return asSphereTree(tree.getCollisionShape()); }
  const btCollisionShape& otherShape() const { return *other.getCollisionShape(); }
  /// The other body's sphere-tree, or null.
  const SphereTreeShape* otherTree() const { return asSphereTree(other.getCollisionShape()); }
};

}  // namespace cairn::bullet
