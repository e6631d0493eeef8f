// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "placement/placed_tree.h"

class btCollisionShape;

namespace cairn::bullet {

class SphereTreeShape;

/// Poses and lengths of a pair in one step: pair frame, world lengths. Every `Collider` is placed by it.
struct PairPlacement {
  const SphereTreeShape* treeShape = nullptr;
  btTransform treeBody;  ///< of the tree's body (or compound child): its rotation, no translation
  PlacedTree tree;
  float smallerSize = 0;                         ///< of the smaller body
  float treeMargin = 0;                          ///< grows the tree's surface
  const btCollisionShape* otherShape = nullptr;  ///< of the kind that the collider was made for
  btTransform other;                             ///< pose of the other body, its origin relative to the pair frame's
  int otherIndex = -1;            ///< index among a compound's children, -1 for none, as in Bullet's wrapper
  float maxSeparation = 0;        ///< contacts with a separation below this are wanted; > 0
  float speculativeDistance = 0;  ///< the same without the part that a query adds; 0: equal to `maxSeparation`
  /// Surfaces nearer than this touch, however far a query looks.
  float contactDistance() const { return speculativeDistance > 0 ? speculativeDistance : maxSeparation; }
  float travel = 0;  ///< bound on how far the bodies move against each other in a step
  float slip = 0;    ///< bound on how far the smaller body's points move in the larger's frame in a step
};

}  // namespace cairn::bullet
