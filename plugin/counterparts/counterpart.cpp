// SPDX-License-Identifier: Zlib
#include "counterparts/counterpart.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <limits>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/terrain_shape.h"
#include "counterparts/convex_counterpart.h"
#include "counterparts/distance_field.h"
#include "counterparts/field_counterpart.h"
#include "counterparts/plane_counterpart.h"
#include "counterparts/terrain_counterpart.h"
#include "counterparts/tree_counterpart.h"
#include "counterparts/triangle_counterpart.h"

namespace cairn::bullet {

Vec3 Counterpart::flatten(std::span<Contact> /*cluster*/, std::span<const Vec3> /*lasts*/,
                          std::vector<Contact>& /*strays*/) {
  return {};
}

std::optional<float> Counterpart::appendOfMesh(const MeshQuestion& /*question*/, std::vector<Contact>& /*contacts*/) {
  return std::nullopt;
}

namespace {

// Concave by name, but its `processAllTriangles` is empty. Others may share its type number.
bool hidesTriangles(const btCollisionShape& shape) {
  return shape.getShapeType() == GIMPACT_SHAPE_PROXYTYPE &&
         dynamic_cast<const btGImpactCompoundShape*>(&shape) != nullptr;
}

}  // namespace

std::optional<CounterpartKind> kindOf(const btCollisionShape& shape) {
  if (asSphereTree(&shape)) return CounterpartKind::tree;
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) return CounterpartKind::plane;
  if (shape.isConvex()) return CounterpartKind::convex;
  if (asField(shape)) return CounterpartKind::field;
  if (asTerrain(&shape)) return CounterpartKind::terrain;
  if (!shape.isConcave() || hidesTriangles(shape)) return std::nullopt;
  return CounterpartKind::triangles;
}

void Counterpart::appendContacts(std::span<const NodePair> pairs, std::span<float> gaps,
                                 std::vector<Contact>& contacts) {
  std::fill(gaps.begin(), gaps.end(), -std::numeric_limits<float>::infinity());
  appendContacts(pairs, contacts);
}

std::unique_ptr<Counterpart> makeCounterpart(CounterpartKind kind) {
  switch (kind) {
    case CounterpartKind::tree:
      return std::make_unique<TreeCounterpart>();
    case CounterpartKind::plane:
      return std::make_unique<PlaneCounterpart>();
    case CounterpartKind::convex:
      return std::make_unique<ConvexCounterpart>();
    case CounterpartKind::field:
      return std::make_unique<FieldCounterpart>();
    case CounterpartKind::terrain:
      return std::make_unique<TerrainCounterpart>();
    case CounterpartKind::triangles:
      break;
  }
  return std::make_unique<TriangleCounterpart>();
}

}  // namespace cairn::bullet
