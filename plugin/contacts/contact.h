// SPDX-License-Identifier: Zlib
#pragma once

#include <compare>
#include <cstdint>
#include <tuple>

#include "cairn/core/traversal.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Origin of a contact point on both sides, as written into Bullet's manifold point (part, index).
///
/// | side | part | index |
/// | --- | --- | --- |
/// | tree | the leaf's level, or a `ContactPart` | the leaf's `NodeId`, or the feature |
/// | triangle mesh | the mesh's own part | the triangle |
/// | terrain | 0, or 1 + the support point | the triangle |
/// | other | the support point (-1: the extreme one) or the point on a feature | -1, or the child of a compound |
///
/// A flat leaf touches a flat shape in several support points; the part tells them apart.
struct ContactId {
  int treePart = -1, treeIndex = -1;
  int otherPart = -1, otherIndex = -1;

  friend constexpr auto operator<=>(const ContactId&, const ContactId&) = default;
};

/// The part of a guard of a pair that must not move until it is resolved.
enum class Lock : std::uint8_t {
  none,     ///< the pair is not locked
  guard,    ///< forbids approach, and sliding
  opposite  ///< forbids parting, and sliding
};

/// A possible contact point between a sphere-tree and its collider, in the *pair frame*: world axes and unit, origin at
/// the tree's body. Numbers stay small there, so that float stays accurate far from the world's origin.
struct Contact {
  /// Half-way between the two surfaces. For a speculative contact: the place where the smaller body's point will stop.
  Vec3 position;
  Vec3 normal;           ///< unit, from the collider to the tree
  float separation = 0;  ///< along the normal, negative where the surfaces overlap
  /// The solver is told that the surfaces are farther apart by this length; see `RelativeMotion::curvatureCorrection`.
  float curvatureCorrection = 0;
  /// For bounding spheres: how far balls inside both bodies overlap, so that the bodies certainly overlap; otherwise 0.
  float certainDepth = 0;
  Vec3 separationVector;  ///< of a speculative contact: from the collider's point to the tree's, now
  NodePair pair;          ///< from the traversal that found it; both roots where meshes found it
  ContactId id;
  bool isInManifold = false;  ///< its id is in the manifold already
  bool ofSpheres = false;     ///< of bounding spheres, or speculative: not measured again
  /// For an exact contact: bound on how far apart the bodies may be in spite of it. Both points lie on the surfaces, so
  /// the bound is at most the depth. Bodies that overlap along the normal may lie beside each other.
  float exactError = 0;
  bool isExact = false;  ///< measured between source triangles
  /// Will be a contact within the step: see `separationVector`. `separation` is then the value at the end of the step
  /// if nothing stopped the bodies.
  bool isSpeculative = false;
  /// Speculative, and another contact stops the bodies earlier: it holds, but does not bounce.
  bool isSecondary = false;
  bool treeIsLarger = false;   ///< of a speculative contact: the smaller body is the collider
  bool isRootContact = false;  ///< of whole bodies: the nearest point in its direction, so its id may change
  bool isGuard = false;        ///< of spheres that must not come nearer, whether or not their contents touch
  Lock lock = Lock::none;      ///< of a guard

  /// World length from the collider's point to the tree's, along the normal.
  float distance() const { return isSpeculative ? dot(normal, separationVector) : separation; }
  /// The point on the tree's surface, pair frame.
  Vec3 onTree() const {
    if (isSpeculative) return treeIsLarger ? onCollider() + separationVector : position + normal * distance();
    return position + normal * (0.5F * separation);
  }
  /// The point on the collider's surface, pair frame.
  Vec3 onCollider() const {
    if (isSpeculative) return treeIsLarger ? position - normal * distance() : onTree() - separationVector;
    return position - normal * (0.5F * separation);
  }
};

/// Sorts the deepest first. Ties are decided by the id, so that the order depends on the pair alone. Both ways of a
/// locked guard have one id; their normals tell them apart.
inline bool deeper(const Contact& x, const Contact& y) {
  if (x.separation != y.separation) return x.separation < y.separation;
  if (x.id != y.id) return x.id < y.id;
  return std::tie(x.normal.x, x.normal.y, x.normal.z) < std::tie(y.normal.x, y.normal.y, y.normal.z);
}

}  // namespace cairn::bullet
