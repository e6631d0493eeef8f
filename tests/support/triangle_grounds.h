// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

namespace cairn::test {

/// What Bullet offers to make ground of triangles.
enum class TriangleGround { mesh, scaledMesh, terrain, gimpact };

/// A mesh and what shares it, alive as long as the shape.
struct OwnedMesh {
  btTriangleMesh mesh;
  std::unique_ptr<btBvhTriangleMeshShape> bvh;
};

/// A flat square at height 0, 20 m wide or more, in cells of about one metre; nothing lies on a cell's corner at the
/// origin.
inline std::shared_ptr<btCollisionShape> flatGround(TriangleGround kind) {
  if (kind == TriangleGround::terrain) {
    // Bullet's double-precision build reads PHY_FLOAT heights as doubles.
    static const std::vector<btScalar> heights(24 * 24, btScalar(0));
    return std::make_shared<btHeightfieldTerrainShape>(24, 24, heights.data(), 1, -1, 1, 2, PHY_FLOAT, false);
  }
  auto owned = std::make_shared<OwnedMesh>();
  for (int i = -15; i < 15; ++i)
    for (int j = -15; j < 15; ++j) {
      const btScalar x = btScalar(i) + btScalar(0.3), y = btScalar(j) + btScalar(0.2);
      const btVector3 a(x, y, 0), b(x + 1, y, 0), c(x + 1, y + 1, 0), d(x, y + 1, 0);
      owned->mesh.addTriangle(a, b, c);
      owned->mesh.addTriangle(a, c, d);
    }
  const auto sharing = [&](auto shape) {
    const auto kept = std::shared_ptr<btCollisionShape>(std::move(shape));
    return std::shared_ptr<btCollisionShape>(kept.get(), [kept, owned](btCollisionShape*) {});
  };
  if (kind == TriangleGround::gimpact) {
    auto shape = std::make_unique<btGImpactMeshShape>(&owned->mesh);
    shape->updateBound();
    return sharing(std::move(shape));
  }
  owned->bvh = std::make_unique<btBvhTriangleMeshShape>(&owned->mesh, true);
  if (kind == TriangleGround::mesh) return {owned->bvh.get(), [owned](btCollisionShape*) {}};
  return sharing(
      std::make_unique<btScaledBvhTriangleMeshShape>(owned->bvh.get(), btVector3(btScalar(0.7), btScalar(0.8), 1)));
}

/// A shape of these triangles, each of three consecutive corners.
inline std::shared_ptr<btCollisionShape> meshOf(const std::vector<btVector3>& corners) {
  auto owned = std::make_shared<OwnedMesh>();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    owned->mesh.addTriangle(corners[i], corners[i + 1], corners[i + 2]);
  owned->bvh = std::make_unique<btBvhTriangleMeshShape>(&owned->mesh, true);
  return {owned->bvh.get(), [owned](btCollisionShape*) {}};
}

}  // namespace cairn::test
