// SPDX-License-Identifier: Zlib
#pragma once

#include <compare>

#include "cairn/core/traversal.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// What a contact point came from, as it is written into Bullet's manifold point (part, index) of either side. On a
/// tree: the leaf's level and its `NodeId`, or as `ContactPart` says. On a triangle mesh: the mesh's own part and
/// triangle. On a terrain: the triangle, and as part 0, or one plus which of a flat leaf's support points it is. On
/// anything else as Bullet has it: index -1, or which child of a compound it is; and as part, because a flat leaf
/// touches a flat shape in several points, which of the leaf's support points it is (-1 for the extreme one), or of the
/// points on a feature of the mesh.
struct ContactId {
  int treePart = -1, treeIndex = -1;
  int otherPart = -1, otherIndex = -1;

  friend constexpr auto operator<=>(const ContactId&, const ContactId&) = default;
};

/// One possible contact point between a sphere-tree and its collider, in the *pair frame*: world axes and unit,
/// origin at the tree's body. Small numbers there keep float accuracy far from the world's origin.
struct Contact {
  Vec3 position;  ///< half-way between the two surfaces; of a contact ahead where the smaller body's point will stop
  Vec3 normal;    ///< unit, from the collider to the tree
  float separation = 0;  ///< distance of the surfaces along the normal, negative when they overlap
  float curvatureCorrection =
      0;  ///< see `RelativeMotion::curvatureCorrection`: the solver is told that the surfaces are so much farther apart
  float certainDepth = 0;  ///< of spheres: how far balls inside both bodies overlap, so that these certainly do; or 0
  Vec3 separationVector;   ///< of a contact ahead: from the collider's point to the tree's, as they are now
  NodePair pair;           ///< of the traversal that found it; both roots where meshes told it, which know no leaves
  ContactId id;
  bool isInManifold = false;  ///< its id is in the manifold already
  bool ofSpheres = false;     ///< of bounding spheres, not of what they hold, or ahead: not measured again
  /// Of an exact one: how far apart the bodies may be for all that. Both its points are on their surfaces, so it is no
  /// more than its depth: what has crossed in its direction may be past each other.
  float exactError = 0;
  bool isExact = false;        ///< measured between source triangles
  bool isSpeculative = false;  ///< will be one within the step: see `separationVector`; `separation` is where it would
                               ///< end, if nothing held it
  bool isSecondary = false;  ///< ahead, and something else stops the bodies before: holds, and does not throw them back
  bool treeIsLarger = false;   ///< of a contact ahead: the smaller body is the collider
  bool isRootContact = false;  ///< of whole bodies: whatever is nearest in its direction, so that its id may change
  bool isGuard = false;        ///< of spheres that may not come nearer, whether what is in them touches or not

  /// World length from the collider's point to the tree's along the normal.
  float distance() const { return isSpeculative ? dot(normal, separationVector) : separation; }
  Vec3 onTree() const {
    if (isSpeculative) return treeIsLarger ? onCollider() + separationVector : position + normal * distance();
    return position + normal * (0.5F * separation);
  }
  Vec3 onCollider() const {
    if (isSpeculative) return treeIsLarger ? position - normal * distance() : onTree() - separationVector;
    return position - normal * (0.5F * separation);
  }
};

/// Deepest first; ties in an order that depends on nothing but the pair.
inline bool deeper(const Contact& x, const Contact& y) {
  if (x.separation != y.separation) return x.separation < y.separation;
  return x.id < y.id;
}

}  // namespace cairn::bullet
