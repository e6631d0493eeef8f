// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>

#include "test_solids.h"

namespace cairn::test {

/// A solid as GImpact has it. Shape and mesh live as long as either.
inline std::shared_ptr<btCollisionShape> gimpactMesh(const Solid& solid, btScalar margin) {
  auto mesh = std::make_shared<btTriangleMesh>();
  const auto corner = [&](std::uint32_t i) {
    const Vec3d& v = solid.vertices[i];
    return btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z));
  };
  for (const auto& t : solid.triangles) mesh->addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
  auto shape = std::make_shared<btGImpactMeshShape>(mesh.get());
  shape->setMargin(margin);
  shape->updateBound();
  return {shape.get(), [mesh, shape](btCollisionShape*) {}};
}

}  // namespace cairn::test
