// SPDX-License-Identifier: Zlib
//
// Microseconds a ray and a sweep take, by what they ask: a sphere-tree, the same tree by the box around the whole way
// (Bullet's generic path), and Bullet's own mesh shapes of the same triangles. One thread, CPU time, best of
// interleaved runs. Ends with 1 when closest hits differ.
#include <fmt/format.h>

#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cairn/core/tree_file.h"
#include "casts.h"
#include "cpu_seconds.h"
#include "test_trees.h"

namespace cairn::bench {
namespace {

using bullet::SphereTreeShape;
using test::Way;

struct Options {
  std::vector<std::string> trees;
  std::size_t rays = 2000, sweeps = 20, runs = 3;
  double spread = 2;
  std::uint64_t seed = 1;
};

/// Bullet's generic path: the shape hands out what is near the box and does not see what for.
class ByBox final : public btConcaveShape {
 public:
  explicit ByBox(const SphereTreeShape& shape) : shape_(shape) { m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE; }
  void processAllTriangles(btTriangleCallback* callback, const btVector3& lower,
                           const btVector3& upper) const override {
    test::HandOn all(*callback);
    shape_.processAllTriangles(&all, lower, upper);
  }
  void getAabb(const btTransform& t, btVector3& lower, btVector3& upper) const override {
    shape_.getAabb(t, lower, upper);
  }
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return shape_.getLocalScaling(); }
  void calculateLocalInertia(btScalar, btVector3&) const override {}
  const char* getName() const override { return "ByBox"; }

 private:
  const SphereTreeShape& shape_;
};

/// Everything that is asked, of the same triangles in the same place.
struct Asked {
  explicit Asked(std::shared_ptr<const SphereTree> tree)
      : shape(SphereTreeShape::create(tree, bullet::BodyFrame::mesh).value()), box(*shape) {
    test::copyTriangles(*shape, mesh);
    bvh = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
    gimpact = std::make_unique<btGImpactMeshShape>(&mesh);
    gimpact->updateBound();
  }
  std::vector<std::pair<std::string, btCollisionShape*>> all() {
    return {{"tree", shape.get()}, {"bvh", bvh.get()}, {"gimpact", gimpact.get()}, {"tree by box", &box}};
  }

  std::unique_ptr<SphereTreeShape> shape;
  ByBox box;
  btTriangleMesh mesh;
  std::unique_ptr<btBvhTriangleMeshShape> bvh;
  std::unique_ptr<btGImpactMeshShape> gimpact;
};

using Cast = std::function<btScalar(const Way&, btCollisionObject&)>;

btScalar castRay(const Way& way, btCollisionObject& object) {
  btCollisionWorld::ClosestRayResultCallback result(way.from, way.to);
  const btTransform from(btQuaternion::getIdentity(), way.from), to(btQuaternion::getIdentity(), way.to);
  btCollisionWorld::rayTestSingle(from, to, &object, object.getCollisionShape(), object.getWorldTransform(), result);
  return result.m_closestHitFraction;
}

btScalar sweep(const Way& way, btCollisionObject& object, const btConvexShape& shape) {
  btCollisionWorld::ClosestConvexResultCallback result(way.from, way.to);
  const btTransform from(btQuaternion::getIdentity(), way.from), to(btQuaternion::getIdentity(), way.to);
  btCollisionWorld::objectQuerySingle(&shape, from, to, &object, object.getCollisionShape(), object.getWorldTransform(),
                                      result, 0);
  return result.m_closestHitFraction;
}

struct Row {
  std::string shape;
  double seconds = 1e9;
  std::vector<btScalar> fractions;
};

/// Returns whether all that was asked agree with the first.
bool measure(const std::string& name, Asked& asked, const std::vector<Way>& ways, std::size_t runs, const Cast& cast) {
  std::vector<Row> rows;
  std::vector<btCollisionObject> objects(asked.all().size());
  for (const auto& [shapeName, shape] : asked.all()) {
    objects[rows.size()].setCollisionShape(shape);
    rows.push_back({shapeName, 1e9, std::vector<btScalar>(ways.size())});
  }
  for (std::size_t run = 0; run < runs; ++run)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double start = cpuSeconds();
      for (std::size_t i = 0; i < ways.size(); ++i) rows[r].fractions[i] = cast(ways[i], objects[r]);
      rows[r].seconds = std::min(rows[r].seconds, cpuSeconds() - start);
    }
  bool agree = true;
  for (const Row& row : rows) {
    std::size_t hits = 0, others = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      hits += row.fractions[i] < 1 ? 1 : 0;
      others += std::abs(row.fractions[i] - rows[0].fractions[i]) > btScalar(1e-4) ? 1 : 0;
    }
    agree = agree && others == 0;
    fmt::print("{:8}{:12}{:10.2f}{:8.2f}{:9}{:9}\n", name, row.shape, 1e6 * row.seconds / double(ways.size()),
               row.seconds / rows[1].seconds, hits, others);
  }
  return agree;
}

bool benchTree(const std::string& name, std::shared_ptr<const SphereTree> tree, const Options& options) {
  const double start = cpuSeconds();
  (void)SphereTreeShape::create(tree);
  const double made = cpuSeconds() - start;
  Asked asked(std::move(tree));
  fmt::print("{}: {} triangles, {} leaves, a shape is made in {:.1f} ms\n{:8}{:12}{:>10}{:>8}{:>9}{:>9}\n", name,
             asked.shape->tree().triangles().size(), asked.shape->tree().leafCount(), 1e3 * made, "", "", "us",
             "of bvh", "hits", "differ");
  std::mt19937_64 engine(options.seed);
  const double size = double(asked.shape->size());
  std::vector<Way> rays, sweeps;
  for (std::size_t i = 0; i < options.rays; ++i) rays.push_back(test::randomWay(engine, size, options.spread));
  for (std::size_t i = 0; i < options.sweeps; ++i) sweeps.push_back(test::randomWay(engine, size, options.spread));
  const btSphereShape ball(btScalar(0.05 * size));
  const bool raysAgree = measure("ray", asked, rays, options.runs, castRay);
  const bool sweepsAgree = measure("sweep", asked, sweeps, options.runs,
                                   [&](const Way& way, btCollisionObject& object) { return sweep(way, object, ball); });
  return raysAgree && sweepsAgree;
}

int run(const Options& options) {
  bool agree = true;
  for (const std::string& file : options.trees) {
    Result<SphereTree> tree = loadTree(file);
    if (!tree) {
      fmt::print(stderr, "{}\n", tree.error().message);
      return 2;
    }
    agree = benchTree(file, std::make_shared<const SphereTree>(std::move(tree).value()), options) && agree;
  }
  if (options.trees.empty()) agree = benchTree("torus", test::plainTree(test::torus(1, 0.4, 96), 32), options);
  if (!agree) fmt::print("some closest hits differ\n");
  return agree ? 0 : 1;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  cairn::bench::Options options;
  CLI::App app(
      "Microseconds a ray and a sweep take at sphere-trees and at Bullet's mesh shapes of the same triangles.");
  app.add_option("tree", options.trees, "Trees (default: one of a generated torus)");
  app.add_option("--rays", options.rays, "Rays a run")->check(CLI::PositiveNumber);
  app.add_option("--sweeps", options.sweeps, "Sweeps a run, of a ball of 5 % of the size")->check(CLI::PositiveNumber);
  app.add_option("--runs", options.runs, "Runs, of which the fastest counts")->check(CLI::PositiveNumber);
  app.add_option("--spread", options.spread, "From how far they begin, in sizes of the body")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "Of the rays");
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(options);
}
