// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "scenes/truth/exact_check.h"

namespace cairn::hard {

/// A solid with its tree, and the exact check's view of it, in the tree frame.
struct SmallSolid {
  std::string name;
  builder::TriangleMesh mesh;
  std::shared_ptr<const SphereTree> tree;
  std::unique_ptr<scenes::ExactSurface> surface;
};

inline SmallSolid smallSolid(const std::string& name, builder::TriangleMesh mesh, std::uint32_t depth) {
  builder::BuildOptions options;
  options.depth = depth;
  options.samples = 500;
  Result<SphereTree> tree = builder::buildTree(mesh, options);
  if (!tree) throw std::runtime_error(tree.error().message);
  const Vec3d origin = tree.value().origin();
  std::vector<Vec3d> vertices;
  for (const Vec3d& v : mesh.vertices) vertices.push_back(v - origin);
  const std::vector<std::array<std::uint32_t, 3>> triangles(mesh.triangles.begin(), mesh.triangles.end());
  auto surface = scenes::ExactSurface::create(vertices, triangles);
  if (!surface) throw std::runtime_error(surface.error().message);
  return {name, std::move(mesh), std::make_shared<const SphereTree>(std::move(tree).value()),
          std::make_unique<scenes::ExactSurface>(std::move(surface).value())};
}

/// A few faces, many dents, a hole, a rod; off their own origin, so that the tree frame is not the mesh's.
inline std::vector<SmallSolid> smallSolids(std::uint32_t depth) {
  const auto aside = [](const Vec3d& v) { return v + Vec3d(0.3, -5, 2); };
  std::vector<SmallSolid> solids;
  solids.push_back(smallSolid("cube", test::meshOf(test::cuboid({1, 1, 1}, 1)), depth));
  solids.push_back(smallSolid("dented ball", test::moved(test::lumpyBall(3, 21), aside), depth));
  solids.push_back(smallSolid("torus", test::moved(test::torus(0.8, 0.3, 10, 6), aside), depth));
  solids.push_back(smallSolid("rod", test::meshOf(test::cuboid({3, 0.1, 0.15}, 1)), depth));
  return solids;
}

inline std::unique_ptr<bullet::SphereTreeShape> shapeOf(std::shared_ptr<const SphereTree> tree, btScalar scale = 1) {
  auto shape = bullet::SphereTreeShape::create(std::move(tree), bullet::BodyFrame::principalAxes, scale);
  if (!shape) throw std::runtime_error(shape.error().message);
  return std::move(shape).value();
}

/// Uniform over all turns, as a body of Bullet's has it: floats.
inline btMatrix3x3 randomTurn(std::mt19937_64& engine) {
  const double u = test::uniform(engine), v = 2 * SIMD_PI * test::uniform(engine),
               w = 2 * SIMD_PI * test::uniform(engine);
  const double a = std::sqrt(1 - u), b = std::sqrt(u);
  return btMatrix3x3(btQuaternion(btScalar(a * std::sin(v)), btScalar(a * std::cos(v)), btScalar(b * std::sin(w)),
                                  btScalar(b * std::cos(w))));
}

inline btVector3 randomDirection(std::mt19937_64& engine) {
  const Vec3d d = normalized(test::randomPoint(engine) + Vec3d(1e-9, 0, 0));
  return {btScalar(d.x), btScalar(d.y), btScalar(d.z)};
}

}  // namespace cairn::hard
