// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/bodies/model.h"

namespace cairn::scenes {

/// The collision shape of a moving body.
enum class ShapeKind : std::uint8_t {
  tree,           ///< Cairn's certified sphere-tree
  treeTriangles,  ///< the same tree; contacts are measured between source triangles while the budget lasts
  treeLeaves,     ///< the same tree; contacts are measured between its leaves
  gimpact,        ///< btGImpactMeshShape: the triangles themselves
  hull,           ///< btConvexHullShape: concavities are filled
  spheres,        ///< btCompoundShape of one level of the tree: its spheres, tested by brute force
  compound,       ///< btCompoundShape of the convex hulls into which HACD cuts the mesh
  fcl,            ///< the Flexible Collision Library; only for recorded poses, because it is no Bullet shape
};

/// All kinds, in the order in which they are listed to users.
inline constexpr std::array kShapeKinds{
    ShapeKind::tree, ShapeKind::treeTriangles, ShapeKind::treeLeaves, ShapeKind::gimpact,
    ShapeKind::hull, ShapeKind::spheres,       ShapeKind::compound,   ShapeKind::fcl};

/// True when Cairn's narrow phase handles the shape.
constexpr bool isSphereTree(ShapeKind kind) {
  return kind == ShapeKind::tree || kind == ShapeKind::treeTriangles || kind == ShapeKind::treeLeaves;
}

const char* shapeName(ShapeKind kind);
Result<ShapeKind> parseShape(std::string_view name);

struct ShapeOptions {
  /// Bullet's collision margin as a fraction of body size, for gimpact, hull and compound. Unset: 0.1 % for gimpact, 1
  /// % for hulls; each ran best at its value. A tree and a compound of spheres have none.
  std::optional<double> marginFraction;
  /// Level of the tree from which the shape `spheres` takes its spheres; leaves above it are included.
  std::uint32_t sphereLevel = 2;
  /// See `SphereTreeShape::setMaxContactError`; for trees.
  double maxContactError = 0;
};

/// A shape in the model's body frame, with everything it refers to. One object serves any number of bodies.
///
///     auto shape = BodyShape::create(ShapeKind::tree, model, {});
///     world.addBody(shape.value()->bullet(), pose, 1, model.inertia);
class BodyShape {
 public:
  /// Fails if the sphere-tree shape refuses the tree, for `fcl`, and for `compound` in a build without HACD. The hull
  /// is exact and reduced to its corners. Bullet's coarser reduction (btShapeHull) cuts corners, and the meshes sink in
  /// by the cut depth.
  static Result<std::unique_ptr<BodyShape>> create(ShapeKind kind, const Model& model, const ShapeOptions& options);

  ShapeKind kind() const { return kind_; }
  btCollisionShape& bullet() { return *shape_; }

 private:
  explicit BodyShape(ShapeKind kind) : kind_(kind) {}
  void makeGimpact(const Model& model, btScalar margin);
  Status makeCompound(const Model& model, btScalar margin);
  void makeHull(const Model& model, btScalar margin);
  void makeSpheres(const Model& model, std::uint32_t level);

  ShapeKind kind_;
  std::vector<btScalar> coordinates_;  // of the mesh that gimpact refers to
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::vector<std::unique_ptr<btCollisionShape>> children_;
  std::unique_ptr<btCollisionShape> shape_;
};

}  // namespace cairn::scenes
