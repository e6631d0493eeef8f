// SPDX-License-Identifier: Zlib
#include "pairs/collider_kinds.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/terrain_shape.h"
#include "colliders/convex_collider.h"
#include "colliders/distance_field.h"
#include "colliders/field_collider.h"
#include "colliders/plane_collider.h"
#include "colliders/terrain_collider.h"
#include "colliders/tree_collider.h"
#include "colliders/triangle_collider.h"
#include "continuous/swept_convex.h"
#include "continuous/swept_field.h"
#include "continuous/swept_plane.h"
#include "continuous/swept_tree.h"
#include "continuous/swept_triangles.h"

namespace cairn::bullet {
namespace {

bool isPlane(const btCollisionShape& shape) {
  return shape.getShapeType() == STATIC_PLANE_PROXYTYPE;
}

bool isConvexShape(const btCollisionShape& shape) {
  return shape.isConvex();
}

// A GImpact compound is concave by its type, but its `processAllTriangles` is empty. Other shapes may use its type
// number, hence the name.
bool showsTriangles(const btCollisionShape& shape) {
  const bool hidesThem =
      shape.getShapeType() == GIMPACT_SHAPE_PROXYTYPE && std::strcmp(shape.getName(), "GImpactCompound") == 0;
  return shape.isConcave() && !hidesThem;
}

struct KindTraits {
  ColliderKind kind;
  bool (*isOf)(const btCollisionShape& shape);  ///< asked where all rows before have denied
  std::unique_ptr<Collider> (*makeCollider)();
  std::unique_ptr<SweptTarget> (*makeSweptTarget)();
};

template <class ColliderType, class SweptType>
constexpr KindTraits row(ColliderKind kind, bool (*isOf)(const btCollisionShape&)) {
  return {kind, isOf, [] { return std::unique_ptr<Collider>(std::make_unique<ColliderType>()); },
          [] { return std::unique_ptr<SweptTarget>(std::make_unique<SweptType>()); }};
}

constexpr std::array kKinds{
    row<TreeCollider, SweptTree>(ColliderKind::tree,
                                 [](const btCollisionShape& s) { return asSphereTree(&s) != nullptr; }),
    row<PlaneCollider, SweptPlane>(ColliderKind::plane, isPlane),
    row<ConvexCollider, SweptConvex>(ColliderKind::convex, isConvexShape),
    row<FieldCollider, SweptField>(ColliderKind::field,
                                   [](const btCollisionShape& s) { return asField(s) != nullptr; }),
    row<TerrainCollider, SweptTriangles>(ColliderKind::terrain,
                                         [](const btCollisionShape& s) { return asTerrain(&s) != nullptr; }),
    row<TriangleCollider, SweptTriangles>(ColliderKind::triangles, showsTriangles),
};
static_assert(kKinds.size() == kColliderKinds);
static_assert(std::ranges::is_sorted(kKinds, {}, &KindTraits::kind), "a kind is its row's place");

const KindTraits& traitsOf(ColliderKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

}  // namespace

std::optional<ColliderKind> kindOf(const btCollisionShape& shape) {
  const auto* const found = std::ranges::find_if(kKinds, [&](const KindTraits& traits) { return traits.isOf(shape); });
  if (found == kKinds.end()) return std::nullopt;
  return found->kind;
}

std::unique_ptr<Collider> makeCollider(ColliderKind kind) {
  return traitsOf(kind).makeCollider();
}

std::unique_ptr<SweptTarget> makeSweptTarget(ColliderKind kind) {
  return traitsOf(kind).makeSweptTarget();
}

}  // namespace cairn::bullet
