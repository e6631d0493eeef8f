// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "placement/placed_tree.h"

class btCollisionShape;

namespace cairn::bullet {

class SphereTreeShape;

/// Where the two bodies of a pair stand, in the pair frame.
struct PairPlacement {
  const SphereTreeShape* treeShape = nullptr;
  btTransform treeBody;  ///< of the tree's body (or compound child): its rotation, no translation
  PlacedTree tree;
  float treeMargin = 0;                          ///< grows the tree's surface
  const btCollisionShape* otherShape = nullptr;  ///< of the kind the collider was made for
  btTransform other;                             ///< the other body, its origin relative to the pair frame's
  int otherIndex = -1;            ///< which child of a compound it is, -1 for none, as Bullet's wrapper says
  float maxSeparation = 0;        ///< contacts with a gap below this are wanted; > 0
  float speculativeDistance = 0;  ///< the same without what a query asks for beyond it; 0: as far as `maxSeparation`
  /// How far apart surfaces touch, whatever a query asks for.
  float contactDistance() const { return speculativeDistance > 0 ? speculativeDistance : maxSeparation; }
  float travel = 0;  ///< bound on how far the bodies move against each other in a step
  float slip = 0;    ///< the same of the smaller body's points alone, in the larger's frame
};

}  // namespace cairn::bullet
