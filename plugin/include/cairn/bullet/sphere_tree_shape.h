// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::bullet {

/// Which frame a body with this shape moves in.
enum class BodyFrame : std::uint8_t {
  /// Origin at the mesh's centre of mass, axes along its principal axes: what a btRigidBody needs to tumble as the mesh
  /// would.
  /// Draw the mesh with `bodyTransform * shape.bodyFromMesh()`.
  principalAxes,
  /// The mesh's own frame, for static and kinematic bodies and for children of compounds placed by their mesh frame.
  mesh,
};

/// What rays and convex sweeps hit.
enum class CastTarget : std::uint8_t {
  /// The source mesh, by Bullet's own tests of a triangle. Part 0, index: the source triangle; `leafOf` names its node.
  triangles,
  /// The balls of the tree's leaves, grown by the margin: what bodies collide with. Part: the leaf's level, index: its
  /// `NodeId`. As at a btSphereShape, a ray that begins inside a ball does not hit that ball.
  spheres,
};

/// What the index of a contact point's part means on a tree. Below `vertex` the part is a leaf's level and the index
/// its `NodeId`; with `Finest::triangles`, against another tree, a convex shape or a solid mesh, the index is that of a
/// feature of the source mesh.
enum class ContactPart : std::uint8_t {
  vertex = kMaxDepth + 1,  ///< of `SphereTree::vertices()`
  face,                    ///< of `SphereTree::triangles()`
  edge,                    ///< of `SphereTree::surface().features.edges()`
};

class ExtremePoints;
class LeafBalls;
class RegionBalls;

/// Two surfaces closer than this fraction of the smaller body's size are reported although they do not touch: the
/// solver then lets them close the gap and no more, and resting contacts do not flicker (measured with scheme S).
inline constexpr btScalar kSpeculativeFraction = btScalar(0.002);

/// Which of a tree's levels `serialize` writes as a compound: level two of a tree of eight children has at most 64
/// spheres.
inline constexpr std::uint32_t kDefaultCompoundLevel = 2;

/// A certified sphere-tree as a Bullet collision shape for moving (and static) concave bodies.
///
/// The type is `FAST_CONCAVE_MESH_PROXYTYPE`: every generic path of Bullet that knows only concave shapes (rays,
/// sweeps, debug drawing, pairs nobody registered) works on the source triangles through `processAllTriangles`. Pairs
/// handled by `Dispatcher` use the spheres. One tree serves any number of shapes and bodies.
class SphereTreeShape final : public btConcaveShape {
 public:
  /// The margin, Bullet's `setMargin`, is 0 at first and grows the surface: contacts, boxes and bounding spheres take
  /// it into account. It is metres whatever the scale.
  ///
  /// Fails for a null tree, for a scale that is not positive and finite, and when the diagonal of the scaled mesh's box
  /// is below 1e-21 or above 1e19. Cost: a convex hull of the mesh, and balls around its triangles, n log n, for casts.
  static Result<std::unique_ptr<SphereTreeShape>> create(std::shared_ptr<const SphereTree> tree,
                                                         BodyFrame frame = BodyFrame::principalAxes,
                                                         btScalar scale = 1);

  ~SphereTreeShape() override;

  /// The same with a tree of its own.
  static Result<std::unique_ptr<SphereTreeShape>> create(SphereTree tree, BodyFrame frame = BodyFrame::principalAxes,
                                                         btScalar scale = 1) {
    return create(std::make_shared<const SphereTree>(std::move(tree)), frame, scale);
  }

  const SphereTree& tree() const { return *tree_; }
  const std::shared_ptr<const SphereTree>& sharedTree() const { return tree_; }
  BodyFrame bodyFrame() const { return frame_; }
  btScalar scale() const { return scale_; }

  /// Places the source mesh (times `scale`) in the body's frame.
  const btTransform& bodyFromMesh() const { return bodyFromMesh_; }
  /// Places the tree frame (mesh axes, origin at the tree's origin, times `scale`) in the body's frame.
  const btTransform& bodyFromTree() const { return bodyFromTree_; }
  /// Diagonal of the source mesh's bounding box, scaled: what fractions of "body size" refer to.
  btScalar size() const { return size_; }

  /// Bytes of memory the shape holds of its own, without the tree it shares (`SphereTree::memoryBytes`).
  std::size_t memoryBytes() const;
  CastTarget castTarget() const { return leafBalls_ ? CastTarget::spheres : CastTarget::triangles; }
  /// Of all bodies with this shape. Default: triangles. Not while another thread casts. Cost of `spheres`: linear in
  /// the tree, and 16 bytes a node.
  void setCastTarget(CastTarget target);
  /// A leaf whose ball holds `point` (body's frame) of a source triangle and whose region has a piece of that triangle,
  /// or nothing where there is none. Of several, the one whose centre is nearest. Cost: one descent.
  std::optional<NodeId> leafOf(int triangle, const btVector3& point) const;

  /// Spheres stay spheres only under uniform scale. Anything else, or a scale `create` would refuse, is refused
  /// and leaves the shape as it was.
  Status setScale(const btVector3& scaling);
  /// `setScale`; a refusal is printed on standard error, because Bullet's interface cannot return it. A compound scaled
  /// unevenly hands that on to its children: it moves its trees' places and leaves their size.
  void setLocalScaling(const btVector3& scaling) override;
  /// A margin that is negative, no number, or more than 2^23 times the size (a float's unit of it would be the whole
  /// mesh) is refused in the same way, and leaves the shape as it was.
  void setMargin(btScalar margin) override;
  const btVector3& getLocalScaling() const override { return localScaling_; }

  /// The box of the source mesh's convex hull at this rotation (within 1e-4 of the size), grown by the margin and by
  /// the speculative distance, so that no contact the narrow phase could report is lost to the broad phase. Linear in
  /// the hull's vertices.
  void getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const override;
  /// The tree's root, grown by the margin.
  void getBoundingSphere(btVector3& center, btScalar& radius) const override;
  /// The largest distance of the surface, grown by the margin, from the body's origin (within 1e-4 of the size): how
  /// far a turn moves it. Bullet's contact breaking threshold is 0.02 of it, for pairs that Bullet's own algorithms
  /// handle; those of `Dispatcher` set their own on their manifolds.
  btScalar getAngularMotionDisc() const override { return angularMotionDisc_ + getMargin(); }
  /// Inertia of the solid mesh at uniform density, exact (polyhedral integrals), diagonal in the body's frame: complete
  /// for `principalAxes`, the diagonal about the frame's origin for `mesh`. The margin has no mass.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  /// As btCompoundShape's: the centre of mass and the principal axes in the body's frame, and the moments about them,
  /// ascending. The identity for `principalAxes`. A body in the mesh's frame is turned into one in principal axes by
  /// taking a shape of that frame and `bodyTransform * principal` as its place.
  void calculatePrincipalAxisTransform(btScalar mass, btTransform& principal, btVector3& inertia) const;
  /// The source triangles near the box [aabbMin, aabbMax] (body frame); part 0, index = source triangle.
  /// The source triangles near the box [aabbMin, aabbMax] (body frame); part 0, index = source triangle. A callback of
  /// Bullet's rays or convex sweeps is served along its way instead, whatever the box: its `castTarget` it can hit,
  /// near ones first, until its hit fraction says that nothing farther is wanted.
  void processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                           const btVector3& aabbMax) const override;
  /// Of the kind of shape, as everywhere in Bullet; a shape's own name is given to the serializer.
  const char* getName() const override { return "CairnSphereTree"; }

  /// The level whose spheres `serialize` writes for programs that know only Bullet; leaves above it count as its own.
  std::uint32_t compoundLevel() const { return compoundLevel_; }
  void setCompoundLevel(std::uint32_t level) { compoundLevel_ = level; }
  int calculateSerializeBufferSize() const override;
  /// For `btDefaultSerializer`: a compound of the spheres of `compoundLevel` (radii grown by the margin, all rounded to
  /// float), which Bullet's own importer loads, and beside it the tree, which `WorldImporter` gives back; a tree that
  /// several shapes share is written once. See docs/file-format.md. Linear in the tree.
  const char* serialize(void* dataBuffer, btSerializer* serializer) const override;

 private:
  SphereTreeShape(std::shared_ptr<const SphereTree> tree, BodyFrame frame, btScalar scale);
  void applyScale(btScalar scale);

  std::shared_ptr<const SphereTree> tree_;
  std::unique_ptr<const ExtremePoints> extremes_;
  std::unique_ptr<const RegionBalls> regionBalls_;
  std::unique_ptr<const LeafBalls> leafBalls_;  // only where casts are to hit spheres
  BodyFrame frame_;
  std::uint32_t compoundLevel_ = kDefaultCompoundLevel;
  btScalar scale_ = 1;
  btScalar size_ = 0;
  btScalar angularMotionDisc_ = 0;
  btVector3 localScaling_;
  btTransform bodyFromMesh_, bodyFromTree_;
};

/// The shape as a `SphereTreeShape`, or null. Decided by its class, never by the type number alone, which is free to
/// others.
const SphereTreeShape* asSphereTree(const btCollisionShape* shape);

}  // namespace cairn::bullet
