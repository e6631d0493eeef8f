// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/body_shape.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <span>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "scenes/bodies/convex_parts.h"

namespace cairn::scenes {
namespace {

constexpr double kGimpactMarginFraction = 0.001;
constexpr double kHullMarginFraction = 0.01;

/// The exact hull of some points, reduced to its corners.
std::unique_ptr<btCollisionShape> hullOf(std::span<const Vec3d> points, btScalar margin) {
  std::vector<btScalar> coordinates;
  for (const Vec3d& v : points)
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(static_cast<btScalar>(v[axis]));
  btConvexHullComputer hull;
  hull.compute(coordinates.data(), static_cast<int>(3 * sizeof(btScalar)), static_cast<int>(points.size()), 0, 0);
  auto shape = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < hull.vertices.size(); ++i) shape->addPoint(hull.vertices[i], false);
  shape->setMargin(margin);
  shape->recalcLocalAabb();
  return shape;
}

}  // namespace

const char* shapeName(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::tree:
      return "tree";
    case ShapeKind::treeTriangles:
      return "tree+triangles";
    case ShapeKind::treeLeaves:
      return "tree+leaves";
    case ShapeKind::gimpact:
      return "gimpact";
    case ShapeKind::hull:
      return "hull";
    case ShapeKind::spheres:
      return "spheres";
    case ShapeKind::compound:
      return "compound";
    case ShapeKind::fcl:
      return "fcl";
  }
  return "";
}

Result<ShapeKind> parseShape(std::string_view name) {
  for (const ShapeKind kind : kShapeKinds)
    if (name == shapeName(kind)) return kind;
  return Error{"there is no shape '" + std::string(name) +
               "': use tree, tree+triangles, tree+leaves, gimpact, hull, spheres, compound or fcl"};
}

Result<std::unique_ptr<BodyShape>> BodyShape::create(ShapeKind kind, const Model& model, const ShapeOptions& options) {
  auto body = std::unique_ptr<BodyShape>(new BodyShape(kind));
  const auto margin = [&](double fraction) {
    return static_cast<btScalar>(options.marginFraction.value_or(fraction) * model.size);
  };
  switch (kind) {
    case ShapeKind::tree:
    case ShapeKind::treeTriangles:
    case ShapeKind::treeLeaves: {
      auto shape = bullet::SphereTreeShape::create(model.tree, bullet::BodyFrame::principalAxes,
                                                   static_cast<btScalar>(model.scale));
      if (!shape) return shape.error();
      if (Status s = shape.value()->setMaxContactError(btScalar(options.maxContactError)); !s) return s.error();
      body->shape_ = std::move(shape).value();
      break;
    }
    case ShapeKind::gimpact:
      body->makeGimpact(model, margin(kGimpactMarginFraction));
      break;
    case ShapeKind::hull:
      body->makeHull(model, margin(kHullMarginFraction));
      break;
    case ShapeKind::spheres:
      body->makeSpheres(model, options.sphereLevel);
      break;
    case ShapeKind::compound:
      if (Status made = body->makeCompound(model, margin(kHullMarginFraction)); !made) return made.error();
      break;
    case ShapeKind::fcl:
      return Error{"FCL only answers recorded poses: it cannot be the shape of a simulated body"};
  }
  return body;
}

void BodyShape::makeGimpact(const Model& model, btScalar margin) {
  for (const Vec3d& v : model.vertices)
    for (int axis = 0; axis < 3; ++axis) coordinates_.push_back(static_cast<btScalar>(v[axis]));
  for (const auto& triangle : model.triangles)
    for (const std::uint32_t corner : triangle) indices_.push_back(static_cast<int>(corner));
  mesh_ = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(model.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(model.vertices.size()), coordinates_.data(), static_cast<int>(3 * sizeof(btScalar)));
  auto shape = std::make_unique<btGImpactMeshShape>(mesh_.get());
  shape->setMargin(margin);
  shape->updateBound();
  shape_ = std::move(shape);
}

void BodyShape::makeHull(const Model& model, btScalar margin) {
  shape_ = hullOf(model.vertices, margin);
}

Status BodyShape::makeCompound(const Model& model, btScalar margin) {
  const auto parts = convexParts(model.vertices, model.triangles);
  if (!parts) return parts.error();
  auto compound = std::make_unique<btCompoundShape>();
  for (const std::vector<Vec3d>& corners : parts.value()) {
    children_.push_back(hullOf(corners, margin));
    compound->addChildShape(btTransform::getIdentity(), children_.back().get());
  }
  shape_ = std::move(compound);
  return {};
}

void BodyShape::makeSpheres(const Model& model, std::uint32_t level) {
  auto compound = std::make_unique<btCompoundShape>();
  for (const NodeId node : model.tree->levelCut(level)) {
    const Sphere sphere = model.tree->sphere(node);
    children_.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(sphere.radius * model.scale)));
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), toBullet(model.bodyFromTree(sphere.center))),
                            children_.back().get());
  }
  shape_ = std::move(compound);
}

}  // namespace cairn::scenes
