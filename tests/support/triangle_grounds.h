// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMaterial.h>
#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexMaterialArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <memory>
#include <vector>

#include "test_solids.h"

namespace cairn::test {

/// Bullet's shapes for ground of triangles.
enum class TriangleGround { mesh, scaledMesh, terrain, gimpact };

/// A mesh and what shares it, alive as long as the shape.
struct OwnedMesh {
  btTriangleMesh mesh;
  std::unique_ptr<btBvhTriangleMeshShape> bvh;
};

/// A solid as a static mesh. Shape and mesh live as long as either.
inline std::shared_ptr<btCollisionShape> bvhMesh(const Solid& solid) {
  auto owned = std::make_shared<OwnedMesh>();
  const auto corner = [&](std::uint32_t i) {
    const Vec3d& v = solid.vertices[i];
    return btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z));
  };
  for (const auto& t : solid.triangles) owned->mesh.addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
  owned->bvh = std::make_unique<btBvhTriangleMeshShape>(&owned->mesh, true);
  return {owned->bvh.get(), [owned](btCollisionShape*) {}};
}

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
    std::shared_ptr<btCollisionShape> kept(std::move(shape));
    // The shape goes first: GImpact's looks at its mesh once more.
    return std::shared_ptr<btCollisionShape>(kept.get(), [owned, kept](btCollisionShape*) mutable { kept.reset(); });
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

/// The same square, its two triangles a cell of different materials: friction 0.2 and 0.9, which Bullet leaves to
/// whoever asks the shape.
inline std::shared_ptr<btCollisionShape> flatGroundOfMaterials() {
  constexpr int kCells = 30;
  struct Owned {
    std::vector<btVector3> vertices;
    std::vector<int> indices;
    std::array<btMaterial, 2> materials{btMaterial(btScalar(0.2), 0), btMaterial(btScalar(0.9), 0)};
    std::vector<int> materialOf;
    std::unique_ptr<btTriangleIndexVertexMaterialArray> mesh;
    std::unique_ptr<btMultimaterialTriangleMeshShape> shape;
  };
  auto owned = std::make_shared<Owned>();
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      owned->vertices.emplace_back(btScalar(i - kCells / 2) + btScalar(0.3), btScalar(j - kCells / 2) + btScalar(0.2),
                                   btScalar(0));
  const auto vertex = [](int i, int j) { return i * (kCells + 1) + j; };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      owned->indices.insert(owned->indices.end(), {a, b, c, a, c, d});
      owned->materialOf.insert(owned->materialOf.end(), {0, 1});
    }
  const int triangles = static_cast<int>(owned->materialOf.size());
  owned->mesh = std::make_unique<btTriangleIndexVertexMaterialArray>(
      triangles, owned->indices.data(), int(3 * sizeof(int)), static_cast<int>(owned->vertices.size()),
      &owned->vertices[0][0], int(sizeof(btVector3)), 2, reinterpret_cast<unsigned char*>(owned->materials.data()),
      int(sizeof(btMaterial)), owned->materialOf.data(), int(sizeof(int)));
  owned->shape = std::make_unique<btMultimaterialTriangleMeshShape>(owned->mesh.get(), true);
  return {owned->shape.get(), [owned](btCollisionShape*) {}};
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
