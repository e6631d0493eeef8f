// SPDX-License-Identifier: Zlib
#include "colliders/collider.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/terrain_shape.h"
#include "colliders/convex_collider.h"
#include "colliders/distance_field.h"
#include "colliders/field_collider.h"
#include "colliders/plane_collider.h"
#include "colliders/terrain_collider.h"
#include "colliders/tree_collider.h"
#include "colliders/triangle_collider.h"

namespace cairn::bullet {

Vec3 Collider::alignNormals(std::span<Contact> /*cluster*/, std::span<const Vec3> /*lasts*/,
                            std::vector<Contact>& /*outliers*/) {
  return {};
}

std::optional<float> Collider::appendOfMesh(const MeshQuery& /*question*/, std::vector<Contact>& /*contacts*/) {
  return std::nullopt;
}

namespace {

// Concave by its type, but its `processAllTriangles` is empty. Other shapes may use its type number, hence the cast.
bool hidesTriangles(const btCollisionShape& shape) {
  return shape.getShapeType() == GIMPACT_SHAPE_PROXYTYPE && std::strcmp(shape.getName(), "GImpactCompound") == 0;
}

}  // namespace

std::optional<ColliderKind> kindOf(const btCollisionShape& shape) {
  if (asSphereTree(&shape)) return ColliderKind::tree;
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) return ColliderKind::plane;
  if (shape.isConvex()) return ColliderKind::convex;
  if (asField(shape)) return ColliderKind::field;
  if (asTerrain(&shape)) return ColliderKind::terrain;
  if (!shape.isConcave() || hidesTriangles(shape)) return std::nullopt;
  return ColliderKind::triangles;
}

void Collider::appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                              std::vector<Contact>& contacts) {
  std::fill(separations.begin(), separations.end(), -std::numeric_limits<float>::infinity());
  appendContacts(pairs, contacts);
}

std::unique_ptr<Collider> makeCollider(ColliderKind kind) {
  switch (kind) {
    case ColliderKind::tree:
      return std::make_unique<TreeCollider>();
    case ColliderKind::plane:
      return std::make_unique<PlaneCollider>();
    case ColliderKind::convex:
      return std::make_unique<ConvexCollider>();
    case ColliderKind::field:
      return std::make_unique<FieldCollider>();
    case ColliderKind::terrain:
      return std::make_unique<TerrainCollider>();
    case ColliderKind::triangles:
      break;
  }
  return std::make_unique<TriangleCollider>();
}

}  // namespace cairn::bullet
