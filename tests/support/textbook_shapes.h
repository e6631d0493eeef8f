// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "built_shape.h"
#include "textbook.h"

namespace cairn::test {

inline std::shared_ptr<btCollisionShape> hullShape(const Solid& solid) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const Vec3d& v : solid.vertices) hull->addPoint(btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)), false);
  hull->optimizeConvexHull();
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

/// Bullet's own shapes, exact hulls, and trees of one to three levels of the same meshes. The ball has 5120 triangles.
inline std::vector<TextbookShapes> textbookShapes() {
  const Solid sphere = ball(double(textbook::kRadius), 4);
  const auto solidOf = [](const btVector3& size) {
    return cuboid({double(size.x()), double(size.y()), double(size.z())}, 2);
  };
  const Solid slab = solidOf(textbook::kSlab), tower = solidOf(textbook::kTower);
  std::vector<TextbookShapes> all;
  all.push_back({"stock", std::make_shared<btSphereShape>(textbook::kRadius),
                 std::make_shared<btBoxShape>(textbook::kSlab / 2),
                 std::make_shared<btBoxShape>(textbook::kTower / 2)});
  all.push_back({"hull", hullShape(sphere), hullShape(slab), hullShape(tower)});
  for (std::uint32_t depth = 1; depth <= 3; ++depth)
    all.push_back({"tree " + std::to_string(depth), builtShape(sphere, depth), builtShape(slab, depth),
                   builtShape(tower, depth)});
  return all;
}

}  // namespace cairn::test
