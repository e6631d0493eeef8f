// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "cairn/core/export.h"

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {
class TreeRefit;
}  // namespace cairn

namespace cairn::bullet {

/// The frame in which a body with this shape moves.
enum class BodyFrame : std::uint8_t {
  /// Origin at the mesh's centre of mass, axes along its principal axes. A dynamic `btRigidBody` needs this frame to
  /// tumble as the mesh would. Draw the mesh with `bodyTransform * shape.bodyFromMesh()`.
  principalAxes,
  /// The mesh's own frame: for static and kinematic bodies, and for children of compounds placed by their mesh frame.
  mesh,
};

/// The geometry that rays and convex sweeps hit.
enum class CastTarget : std::uint8_t {
  /// The source mesh, by Bullet's own triangle tests. A hit has part 0 and the source triangle as index; `leafOf` finds
  /// its node.
  triangles,
  /// The balls of the tree's leaves, grown by the margin, as in body contacts. A hit has the leaf's level as part and
  /// its `NodeId` as index. A ray that begins inside a ball does not hit that ball, as with `btSphereShape`.
  spheres,
};

/// The meaning of a contact point's index on a tree, given by its part. A part below `vertex` is a leaf's level, and
/// the index is its `NodeId`. With `Finest::triangles`, contacts against a tree, a convex shape or a solid mesh name
/// features of the source mesh. Where a coarser mesh is used (`SphereTreeShape::contactLevel`), the same lists are
/// those of `SphereTree::levelView`.
enum class ContactPart : std::uint8_t {
  vertex = kMaxDepth + 1,  ///< the index is that of `SphereTree::vertices()`
  face,                    ///< the index is that of `SphereTree::triangles()`
  edge,                    ///< the index is that of `SphereTree::surface().features.edges()`
};

class ExtremePoints;
class LeafBalls;
class RegionBalls;
class UnservedWatch;

/// Surfaces closer than this fraction of the smaller body's size are reported although they do not touch. The solver
/// then lets them close the separation and no more, so that resting contacts do not flicker (measured with scheme S).
inline constexpr btScalar kSpeculativeFraction = btScalar(0.002);

/// A level mesh serves contacts only where its distance to the source is at most this part of the body's thickness
/// (`TreeSurface::thickness`). Both sides of a wall may be that far off; together they stay within half of it, to which
/// contacts are trusted. `LevelMesh.OfAShellIsNotUsedWhereItIsFartherThanTheWallAllows` fails with 1.
inline constexpr float kMaxErrorOfThickness = 0.25F;

/// Scale factors that differ by no more than this fraction are uniform: some units in the last place of a float, as an
/// engine gets them by decomposing and composing matrices.
inline constexpr btScalar kScaleRounding = btScalar(4e-6);

/// The default level that `serialize` writes as a compound. Level 2 of a tree with branching 8 has at most 64 spheres.
inline constexpr std::uint32_t kDefaultCompoundLevel = 2;

/// A certified sphere-tree as a Bullet collision shape, for moving and static concave bodies.
///
///     auto tree = cairn::loadTree("bunny.cairn");
///     if (!tree) return fail(tree.error().message);
///     auto shape = cairn::bullet::SphereTreeShape::create(std::move(tree).value());
///     if (!shape) return fail(shape.error().message);
///
/// The type is `FAST_CONCAVE_MESH_PROXYTYPE`. So Bullet's generic code for concave shapes works on the source
/// triangles, through `processAllTriangles`: rays, sweeps, debug drawing and unregistered pairs. Pairs handled by
/// `Dispatcher` use the spheres. One tree serves any number of shapes and bodies.
class CAIRN_BULLET_EXPORT SphereTreeShape final : public btConcaveShape {
 public:
  /// Creates the shape with margin 0 and casts on triangles. The margin (`setMargin`) grows contacts, boxes and
  /// bounding spheres; it is in metres at any scale.
  ///
  /// Fails for a null tree, and for a scale that is not positive and finite. Fails also when the diagonal of the scaled
  /// mesh's box is below 1e-21 or above 1e19. Cost: n log n in the mesh, for its convex hull and for balls around its
  /// triangles that speed up casts.
  static Result<std::unique_ptr<SphereTreeShape>> create(std::shared_ptr<const SphereTree> tree,
                                                         BodyFrame frame = BodyFrame::principalAxes,
                                                         btScalar scale = 1);

  ~SphereTreeShape() override;

  /// Creates the shape with a tree that no other shape shares.
  static Result<std::unique_ptr<SphereTreeShape>> create(SphereTree tree, BodyFrame frame = BodyFrame::principalAxes,
                                                         btScalar scale = 1) {
    return create(std::make_shared<const SphereTree>(std::move(tree)), frame, scale);
  }

  /// The tree that bodies with this shape collide as.
  const SphereTree& tree() const { return *tree_; }
  /// The tree, to be shared with other shapes.
  const std::shared_ptr<const SphereTree>& sharedTree() const { return tree_; }
  /// The frame that `create` was given.
  BodyFrame bodyFrame() const { return frame_; }
  /// World length of the mesh's unit.
  btScalar scale() const { return scale_; }

  /// Maps the source mesh (times `scale`) to the body's frame.
  const btTransform& bodyFromMesh() const { return bodyFromMesh_; }
  /// Maps the tree frame (mesh axes, origin at the tree's origin, times `scale`) to the body's frame.
  const btTransform& bodyFromTree() const { return bodyFromTree_; }
  /// Diagonal of the source mesh's bounding box, scaled. All fractions of "body size" refer to this length.
  btScalar size() const { return size_; }

  /// Bytes of memory that belong to this shape alone, without the shared tree (`SphereTree::memoryBytes`).
  std::size_t memoryBytes() const;
  /// The target that rays and sweeps hit now; see `setCastTarget`.
  CastTarget castTarget() const { return leafBalls_ ? CastTarget::spheres : CastTarget::triangles; }
  /// Sets the target for all bodies with this shape; triangles at first. Do not call while another thread casts. Cost
  /// of `spheres`: linear in the tree, and 16 bytes a node.
  void setCastTarget(CastTarget target);
  /// Sets how far contacts may be off, as a fraction of the smaller body's size. A pair's contacts with a tree, a
  /// convex shape or a solid mesh are measured on the coarsest level mesh whose certified distance to the source is no
  /// more. 0 at first: on the source. At 0.5 % a heap of a mesh of 120,000 triangles takes a fortieth of the time.
  /// `StepStatistics` counts the distance as an error. Level meshes come from
  /// `cairn build --level-meshes`. Fails for a fraction that is negative or NaN. Do not call during a step.
  Status setMaxContactError(btScalar fraction);
  /// The fraction set; 0 for the source.
  btScalar maxContactError() const { return maxContactError_; }
  /// The level whose mesh is used in a pair whose smaller body has this size (world length); 0 for the source. A level
  /// mesh whose error could pass a thin wall's middle is never used.
  std::uint32_t contactLevel(btScalar smallerSize) const;
  /// Finds the leaf for a `point` of a source triangle (body frame). The leaf's ball holds the point, and its region
  /// has a piece of the triangle. Of several leaves, the nearest centre wins; none gives an empty result. Cost: one
  /// descent.
  std::optional<NodeId> leafOf(int triangle, const btVector3& point) const;

  /// Spheres stay spheres only under uniform scale. A scale that is not uniform, or that `create` would refuse, fails
  /// and leaves the shape unchanged.
  Status setScale(const btVector3& scaling);
  /// Moves the mesh's vertices (mesh frame, unscaled, in the order of `tree().vertices()`). From now on, `tree()` is
  /// another tree: the first one refitted and certified again, as `TreeRefit` says. Pairs, casts and boxes notice. Mass
  /// and frames stay those of the first mesh, and level meshes are gone. The solver learns no velocity of the surface.
  /// A failure leaves the shape unchanged. Cost: linear; the first call also binds. Do not call during a step.
  Status setVertices(std::span<const Vec3> vertices);
  /// Calls `setScale` and logs a failure (`cairn::setLog`), because Bullet's interface cannot return it. A compound
  /// hands an uneven scale on to its children; it then moves its trees and does not resize them.
  void setLocalScaling(const btVector3& scaling) override;
  /// Refuses a margin that is negative, NaN or more than 2^23 times the size. The unit in the last place of so large a
  /// float exceeds the whole mesh. A refusal is logged and leaves the shape unchanged.
  void setMargin(btScalar margin) override;
  /// The scale as Bullet asks for it: three times the same number.
  const btVector3& getLocalScaling() const override { return localScaling_; }

  /// The box of the source mesh's convex hull at this rotation, within 1e-4 of the size. It is grown by the margin and
  /// by the speculative distance, so that the broad phase loses no possible contact. Cost: linear in the hull's
  /// vertices.
  void getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const override;
  /// The tree's root sphere, grown by the margin.
  void getBoundingSphere(btVector3& center, btScalar& radius) const override;
  /// The largest distance of the surface, margin included, from the body's origin, within 1e-4 of the size. It bounds
  /// how far a rotation moves the surface. Bullet multiplies it by 0.02 for the contact breaking threshold of its own
  /// algorithms. `Dispatcher` sets its own threshold on its manifolds.
  btScalar getAngularMotionDisc() const override { return angularMotionDisc_ + getMargin(); }
  /// Inertia of the solid mesh at uniform density, exact by polyhedral integrals, diagonal in the body's frame. It is
  /// complete for `principalAxes`. For `mesh` it is the diagonal about the frame's origin. The margin has no mass.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  /// Like btCompoundShape's function: gives the centre of mass and principal axes in the body's frame, and the moments
  /// about them, ascending. The transform is the identity for `principalAxes`. To turn a body in the mesh's frame into
  /// one in principal axes, create a shape with that frame. Then place the body at `bodyTransform * principal`.
  void calculatePrincipalAxisTransform(btScalar mass, btTransform& principal, btVector3& inertia) const;
  /// Visits the source triangles near the box [aabbMin, aabbMax] (body frame), with part 0 and the triangle as index. A
  /// callback of Bullet's rays or convex sweeps is served along its path instead, whatever the box. It then gets the
  /// `castTarget` geometry that it can hit, near parts first, until its hit fraction excludes the rest.
  void processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                           const btVector3& aabbMax) const override;
  /// Names the kind of shape, as all of Bullet's shapes do. The serializer gets a shape's own name.
  const char* getName() const override;

  /// The level whose spheres `serialize` writes for programs that know only Bullet. Leaves above the level belong to
  /// it.
  std::uint32_t compoundLevel() const { return compoundLevel_; }
  /// Takes effect at the next `serialize`; a level deeper than the tree means its leaves.
  void setCompoundLevel(std::uint32_t level) { compoundLevel_ = level; }
  /// Bytes of the structure that `serialize` fills.
  int calculateSerializeBufferSize() const override;
  /// For `btDefaultSerializer`. Writes a compound of the spheres of `compoundLevel`, which Bullet's own importer loads.
  /// Radii are grown by the margin, and all numbers are rounded to float. Beside the compound it writes the tree, which
  /// `WorldImporter` restores; a tree that several shapes share is written once. See docs/file-format.md. Cost: linear
  /// in the tree.
  const char* serialize(void* dataBuffer, btSerializer* serializer) const override;

 private:
  SphereTreeShape(std::shared_ptr<const SphereTree> tree, BodyFrame frame, btScalar scale);
  void applyScale(btScalar scale);

  std::shared_ptr<const SphereTree> tree_;
  std::unique_ptr<const ExtremePoints> extremes_;
  std::unique_ptr<RegionBalls> regionBalls_;
  std::unique_ptr<const LeafBalls> leafBalls_;  // null unless casts hit spheres
  std::unique_ptr<UnservedWatch> unserved_;
  std::unique_ptr<TreeRefit> refit_;  // null until vertices move
  BodyFrame frame_;
  std::uint32_t compoundLevel_ = kDefaultCompoundLevel;
  btScalar maxContactError_ = 0;
  btScalar scale_ = 1;
  btScalar size_ = 0;
  btScalar angularMotionDisc_ = 0;
  btVector3 localScaling_;
  btTransform bodyFromMesh_, bodyFromTree_;
};

/// The shape as a `SphereTreeShape`, or null. Decided by its C++ class, because other shapes may use the same type
/// number.
CAIRN_BULLET_EXPORT
const SphereTreeShape* asSphereTree(const btCollisionShape* shape);

}  // namespace cairn::bullet
