// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory of a sphere-tree: the tree, once; each shape of it; each body; each pair of bodies that touch.
// Beside it GImpact, and Bullet's sphere, whose bodies and pairs are what Bullet itself takes.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "cairn/core/tree_file.h"
#include "test_trees.h"

namespace cairn::bench {
namespace {

constexpr int kShapes = 50, kBodies = 200, kPairs = 100, kSteps = 30;
// How far two bodies of a pair are from each other, in widths of their box: they touch, or are deep in each other.
constexpr double kTouching = 0.95, kDeep = 0.5;

using ShapePtr = std::shared_ptr<btCollisionShape>;
using MakeShape = std::function<ShapePtr()>;

// Of everything that was allocated and not freed, by whomever.
double bytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

double bytesOfShape(const MakeShape& make) {
  std::vector<ShapePtr> shapes(kShapes);
  const double before = bytesInUse();
  for (ShapePtr& shape : shapes) shape = make();
  return (bytesInUse() - before) / kShapes;
}

double widthOf(const btCollisionShape& shape) {
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  return double((upper - lower).x());
}

// Bodies beside each other, too far apart to be pairs.
double bytesOfBody(const ShapePtr& shape) {
  const double apart = 2 * widthOf(*shape);
  test::BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  w.add(shape, 1, btVector3(0, 0, 0));
  w.step(2);
  const double before = bytesInUse();
  for (int i = 1; i <= kBodies; ++i) w.add(shape, 1, btVector3(btScalar(apart * i), 0, 0));
  w.step(2);
  return (bytesInUse() - before) / kBodies;
}

// Two and two are put into each other; the most that is held in the steps that follow, beside what was held before.
double bytesOfPair(const ShapePtr& shape, double widths, bool isGimpact) {
  const double width = widthOf(*shape), apart = 2 * width;
  test::BulletWorld<> w;
  if (isGimpact) btGImpactCollisionAlgorithm::registerAlgorithm(&w.dispatcher);
  w.world.setGravity(btVector3(0, 0, 0));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 2 * kPairs; ++i) bodies.push_back(&w.add(shape, 1, btVector3(btScalar(apart * i), 0, 0)));
  w.step(2);
  const double before = bytesInUse();
  for (int i = 0; i < kPairs; ++i) {
    btTransform t = bodies[static_cast<std::size_t>(2 * i)]->getWorldTransform();
    t.setOrigin(t.getOrigin() + btVector3(btScalar(widths * width), 0, 0));
    bodies[static_cast<std::size_t>(2 * i + 1)]->setWorldTransform(t);
  }
  double most = 0;
  for (int i = 0; i < kSteps; ++i) {
    w.step();
    most = std::max(most, bytesInUse() - before);
  }
  return most / kPairs;
}

// GImpact reads the mesh where it lies, as all its shapes do.
class Mesh {
 public:
  explicit Mesh(const SphereTree& tree) {
    for (const Vec3& v : tree.vertices()) vertices_.push_back(btVector3(v.x, v.y, v.z));
    for (const auto& t : tree.triangles())
      for (const std::uint32_t v : t) indices_.push_back(static_cast<int>(v));
    array_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(tree.triangles().size()), indices_.data(), 3 * static_cast<int>(sizeof(int)),
        static_cast<int>(vertices_.size()), &vertices_[0][0], static_cast<int>(sizeof(btVector3)));
  }
  ShapePtr gimpact() const {
    auto shape = std::make_shared<btGImpactMeshShape>(array_.get());
    shape->updateBound();
    return shape;
  }

 private:
  std::vector<btVector3> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> array_;
};

void print(const std::string& name, const MakeShape& make, bool isGimpact = false) {
  const ShapePtr shape = make();
  fmt::print("{:10}{:>14.0f}{:>14.0f}{:>16.0f}{:>14.0f}\n", name, bytesOfShape(make), bytesOfBody(shape),
             bytesOfPair(shape, kTouching, isGimpact), bytesOfPair(shape, kDeep, isGimpact));
}

int run(const std::filesystem::path& path) {
  Result<SphereTree> loaded = Error{};
  if (!path.empty()) {
    loaded = loadTree(path);
    if (!loaded) return fmt::print(stderr, "memory_bench: {}\n", loaded.error().message), 1;
  }
  const auto tree = loaded ? std::make_shared<const SphereTree>(std::move(loaded).value())
                           : std::shared_ptr<const SphereTree>(test::plainTree(test::ball(1, 12), 2));
  fmt::print("tree: {} triangles, {} spheres, {} bytes, shared by all; {} bytes as a file\n\n",
             tree->triangles().size(), tree->nodeCount(), tree->memoryBytes(), encodeTree(*tree).size());
  fmt::print("{:10}{:>14}{:>14}{:>16}{:>14}\n", "bytes per", "shape", "body", "pair, touching", "pair, deep");
  const Mesh mesh(*tree);
  print("tree", [&] { return test::treeShape(tree); });
  print(
      "gimpact", [&] { return mesh.gimpact(); }, true);
  print("sphere", [&] { return std::make_shared<btSphereShape>(btScalar(1)); });
  return 0;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("What a sphere-tree, its shapes, bodies and pairs cost in memory, beside GImpact and a sphere.",
               "memory_bench");
  std::filesystem::path tree;
  app.add_option("TREE", tree, "a .cairn file (default: a generated ball)");
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(tree);
}
