// SPDX-License-Identifier: GPL-3.0-or-later
#include "still/bodies.h"

#include <utility>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "gimpact_mesh.h"

namespace cairn::bench {
namespace {

btVector3 toBullet(const Vec3d& v) {
  return {btScalar(v.x), btScalar(v.y), btScalar(v.z)};
}

std::shared_ptr<btCollisionShape> hullOf(const test::Solid& solid, btScalar margin) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const Vec3d& v : solid.vertices) hull->addPoint(toBullet(v), false);
  hull->optimizeConvexHull();
  hull->setMargin(margin);
  hull->recalcLocalAabb();
  return hull;
}

}  // namespace

Result<TriedShapes> tryShapes(const test::Solid& solid, const std::string& name,
                              std::shared_ptr<btCollisionShape> own) {
  builder::TriangleMesh mesh = test::meshOf(solid);
  mesh.name = name;
  auto built = builder::buildTree(mesh, {});
  if (!built) return built.error();
  TriedShapes tried;
  tried.tree = std::make_shared<const SphereTree>(std::move(built).value());
  const Mat3d& moments = tried.tree->mass().inertia;
  const btVector3 inertia = toBullet({moments(0, 0), moments(1, 1), moments(2, 2)});
  const std::shared_ptr<bullet::SphereTreeShape> tree = test::treeShape(tried.tree);
  const btScalar size = tree->size();
  const btScalar hullMargin = size * btScalar(0.01), gimpactMargin = size * btScalar(0.001);
  tried.shapes = {{"tree", {tree, inertia, 0}},
                  {"own", {std::move(own), inertia, 0}},
                  {"hull", {hullOf(solid, hullMargin), inertia, hullMargin}},
                  {"gimpact", {test::gimpactMesh(solid, gimpactMargin), inertia, gimpactMargin}}};
  return tried;
}

}  // namespace cairn::bench
