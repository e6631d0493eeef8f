// SPDX-License-Identifier: GPL-3.0-or-later
#include "bodies.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "gimpact_mesh.h"
#include "scenes/bodies/body_shape.h"
#include "scenes/bodies/rock.h"

namespace cairn::hard {
namespace {

constexpr std::uint32_t kDepth = 3, kSamples = 2000;
constexpr btScalar kHullMargin = btScalar(0.01),
                   kGimpactMargin = btScalar(0.001);  // parts of the size, as in the demos

std::shared_ptr<const SphereTree> build(const builder::TriangleMesh& mesh, std::uint32_t depth) {
  builder::BuildOptions options;
  options.depth = depth;
  options.samples = kSamples;
  auto tree = builder::buildTree(mesh, options);
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

std::shared_ptr<btCollisionShape> hullOf(const test::Solid& solid, btScalar margin) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const Vec3d& v : solid.vertices) hull->addPoint(scenes::toBullet(v), false);
  hull->optimizeConvexHull();
  hull->setMargin(margin);
  hull->recalcLocalAabb();
  return hull;
}

CaseBodies make(const test::Solid& solid, const std::string& ownName, std::shared_ptr<btCollisionShape> own) {
  const auto tree = build(test::meshOf(solid), kDepth);
  const Mat3d& moments = tree->mass().inertia;
  const btVector3 inertia = scenes::toBullet({moments(0, 0), moments(1, 1), moments(2, 2)});
  const std::shared_ptr<bullet::SphereTreeShape> shape = test::treeShape(tree);
  const btScalar size = shape->size();
  CaseBodies bodies{{"tree", {shape, inertia, 0}}};
  if (own) bodies.push_back({ownName, {std::move(own), inertia, 0}});
  bodies.push_back({"hull", {hullOf(solid, size * kHullMargin), inertia, size * kHullMargin}});
  bodies.push_back({"gimpact", {test::gimpactMesh(solid, size * kGimpactMargin), inertia, size * kGimpactMargin}});
  return bodies;
}

const scenes::Model& modelOfRock(std::uint64_t seed, double size) {
  static std::map<std::pair<std::uint64_t, double>, scenes::Model> models;
  const auto key = std::pair{seed, size};
  if (const auto at = models.find(key); at != models.end()) return at->second;
  const builder::TriangleMesh mesh = scenes::generateRock({.seed = seed, .subdivisions = 2});
  return models.emplace(key, scenes::makeModel(build(mesh, kDepth), size)).first->second;
}

CaseBodies makeRocks(std::uint64_t seed, double size) {
  const scenes::Model& model = modelOfRock(seed, size);
  CaseBodies bodies;
  for (const auto kind : {scenes::ShapeKind::tree, scenes::ShapeKind::hull, scenes::ShapeKind::gimpact}) {
    auto made = scenes::BodyShape::create(kind, model, {});
    if (!made) throw std::runtime_error(made.error().message);
    const std::shared_ptr<scenes::BodyShape> owner = std::move(made).value();
    const btScalar margin = kind == scenes::ShapeKind::tree ? btScalar(0) : owner->bullet().getMargin();
    bodies.push_back({scenes::shapeName(kind), {{owner, &owner->bullet()}, model.inertia, margin}});
  }
  return bodies;
}

std::map<std::string, CaseBodies>& known() {
  static std::map<std::string, CaseBodies> bodies;
  return bodies;
}

}  // namespace

const CaseBodies& bodiesOf(const std::string& key, const test::Solid& solid, const std::string& ownName,
                           std::shared_ptr<btCollisionShape> own) {
  CaseBodies& bodies = known()[key];
  if (bodies.empty()) bodies = make(solid, ownName, std::move(own));
  return bodies;
}

const CaseBodies& cubes(double edge) {
  return boxes({edge, edge, edge});
}

const CaseBodies& boxes(const Vec3d& size) {
  return bodiesOf(fmt::format("box {} {} {}", size.x, size.y, size.z), test::cuboid(size, 1), "box",
                  std::make_shared<btBoxShape>(scenes::toBullet(size / 2)));
}

const CaseBodies& balls(double radius) {
  constexpr int kSubdivisions = 16;
  return bodiesOf(fmt::format("ball {}", radius), test::ball(radius, kSubdivisions), "sphere",
                  std::make_shared<btSphereShape>(btScalar(radius)));
}

const CaseBodies& rocks(std::uint64_t seed, double size) {
  CaseBodies& bodies = known()[fmt::format("rock {} {}", seed, size)];
  if (bodies.empty()) bodies = makeRocks(seed, size);
  return bodies;
}

const test::Solid& solidOfRock(std::uint64_t seed, double size) {
  static std::map<std::pair<std::uint64_t, double>, test::Solid> solids;
  test::Solid& solid = solids[{seed, size}];
  if (solid.vertices.empty()) {
    const scenes::Model& model = modelOfRock(seed, size);
    solid = {{model.vertices.begin(), model.vertices.end()}, {model.triangles.begin(), model.triangles.end()}};
  }
  return solid;
}

std::shared_ptr<btCollisionShape> treeOf(const test::Solid& solid, std::uint32_t depth) {
  return test::treeShape(build(test::meshOf(solid), depth));
}

}  // namespace cairn::hard
