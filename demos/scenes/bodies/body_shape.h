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

/// What a moving body collides as.
enum class ShapeKind : std::uint8_t {
  tree,           ///< Cairn's certified sphere-tree
  treeTriangles,  ///< the same, by name: contacts between source triangles, where the budget lasts
  treeLeaves,     ///< the same, with contacts between its leaves
  gimpact,        ///< btGImpactMeshShape: the triangles themselves
  hull,           ///< btConvexHullShape: dents filled
  spheres,        ///< btCompoundShape of one level of the tree: the same spheres, brute force
  compound,       ///< btCompoundShape of the convex hulls HACD cuts the mesh into
  fcl,            ///< the Flexible Collision Library, which only answers recorded poses: no Bullet shape
};

/// All of them, in the order they are listed to users.
inline constexpr std::array kShapeKinds{
    ShapeKind::tree, ShapeKind::treeTriangles, ShapeKind::treeLeaves, ShapeKind::gimpact,
    ShapeKind::hull, ShapeKind::spheres,       ShapeKind::compound,   ShapeKind::fcl};

/// Whether Cairn's narrow phase answers for it.
constexpr bool isSphereTree(ShapeKind kind) {
  return kind == ShapeKind::tree || kind == ShapeKind::treeTriangles || kind == ShapeKind::treeLeaves;
}

const char* shapeName(ShapeKind kind);
Result<ShapeKind> parseShape(std::string_view name);

struct ShapeOptions {
  /// Bullet's collision margin as a fraction of body size, for gimpact, hull and compound. Unset: 0.1 % for gimpact, 1
  /// % for hulls, at which each ran best; a tree and a compound of spheres have none.
  std::optional<double> marginFraction;
  /// Level of the tree the shape `spheres` takes its spheres from (leaves above it included).
  std::uint32_t sphereLevel = 2;
};

/// A shape in the model's body frame with everything it refers to. One serves any number of bodies.
class BodyShape {
 public:
  /// Fails if the sphere-tree shape refuses the tree, for `fcl`, and for `compound` in a build without HACD. The hull
  /// is exact, reduced to its corners: Bullet's coarser reduction (btShapeHull) cuts corners, and the meshes sink in by
  /// what it cut.
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
  std::vector<btScalar> coordinates_;  // of the mesh gimpact refers to
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::vector<std::unique_ptr<btCollisionShape>> children_;
  std::unique_ptr<btCollisionShape> shape_;
};

}  // namespace cairn::scenes
