// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of a terrain in the narrow phase: rocks that fall, roll and come to rest on rough ground, and rays at it, on
// cairn::bullet::TerrainShape and on Bullet's height field and mesh of the same points. The same recorded poses are
// shown to each ground.
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "casts.h"
#include "cpu_seconds.h"
#include "terrains.h"

namespace cairn::bench {
namespace {

struct Options {
  std::uint32_t rocks = 150;
  int steps = 240, runs = 5, rays = 5000;
  std::vector<double> cells = {2, 1, 0.5, 0.25};
  std::uint64_t seed = 1;
};

constexpr double kWidth = 96, kSlope = 0.35, kRough = 0.15;

class TimedDispatcher final : public bullet::Dispatcher<> {
 public:
  using bullet::Dispatcher<>::Dispatcher;
  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* d) override {
    const double start = cpuSeconds();
    bullet::Dispatcher<>::dispatchAllCollisionPairs(pairs, info, d);
    seconds += cpuSeconds() - start;
  }
  double seconds = 0;
};

// The same points as a TerrainShape and as Bullet's shapes.
struct Grounds {
  explicit Grounds(double cell, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const auto points = static_cast<std::uint32_t>(kWidth / cell) + 1;
    bullet::TerrainGrid grid = test::terrainGrid({points, points, cell}, [&](double x, double y) {
      return kSlope * (kWidth - x) + std::sin(x / 3) * std::cos(y / 4) + kRough * cell * test::uniform(engine, -1, 1);
    });
    grid.diagonals = bullet::TerrainDiagonals::rising;  // as Bullet's height field has them
    heights.assign(grid.heights.begin(), grid.heights.end());
    terrain = test::terrainOf(std::move(grid));
    test::copyTriangles(*terrain, mesh);
    bvh = std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
    const auto [low, high] = std::ranges::minmax(heights);
    // Symmetric about 0, so that Bullet puts height 0 at its origin.
    const btScalar most = std::max(-low, high);
    field = std::make_shared<btHeightfieldTerrainShape>(static_cast<int>(points), static_cast<int>(points),
                                                        heights.data(), btScalar(1), -most, most, 2, PHY_FLOAT, false);
    field->setLocalScaling(btVector3(btScalar(cell), btScalar(cell), 1));
    field->buildAccelerator();
  }
  std::vector<std::pair<std::string, std::shared_ptr<btCollisionShape>>> all() const {
    return {{"terrain", terrain}, {"height field", field}, {"bvh mesh", bvh}};
  }

  std::vector<btScalar> heights;
  btTriangleMesh mesh;
  std::shared_ptr<bullet::TerrainShape> terrain;
  std::shared_ptr<btHeightfieldTerrainShape> field;
  std::shared_ptr<btBvhTriangleMeshShape> bvh;
};

using World = test::BulletWorld<TimedDispatcher>;

struct Scene {
  Scene(const std::shared_ptr<btCollisionShape>& ground, const Options& options) {
    world.add(ground, 0, btVector3(0, 0, 0));
    std::mt19937_64 engine(options.seed);
    const auto tree = test::plainTree(test::ball(0.5, 12));
    for (std::uint32_t i = 0; i < options.rocks; ++i) {
      const btScalar x = btScalar(-40 + 5.0 * (i % 10)), y = btScalar(-42 + 5.5 * (i / 10));
      const btScalar z = btScalar(kSlope * (kWidth / 2 - double(x)) + 2);
      const btTransform turned = test::randomTransform(engine);
      bodies.push_back(&world.add(test::treeShape(tree, btScalar(test::uniform(engine, 0.6, 1.6))), 1,
                                  btVector3(x, y, z), turned.getRotation()));
    }
  }
  World world;
  std::vector<btRigidBody*> bodies;
};

struct Motion {
  btTransform at;
  btVector3 linear, angular;
};

std::vector<std::vector<Motion>> record(const Grounds& grounds, const Options& options) {
  Scene scene(grounds.terrain, options);
  std::vector<std::vector<Motion>> steps;
  for (int i = 0; i < options.steps; ++i) {
    scene.world.step();
    steps.emplace_back();
    for (const btRigidBody* body : scene.bodies)
      steps.back().push_back({body->getWorldTransform(), body->getLinearVelocity(), body->getAngularVelocity()});
  }
  return steps;
}

struct Replay {
  double seconds = 0;
  long contacts = 0;
};

Replay replay(const std::shared_ptr<btCollisionShape>& ground, const std::vector<std::vector<Motion>>& steps,
              const Options& options) {
  Scene scene(ground, options);
  Replay result;
  for (const std::vector<Motion>& step : steps) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      scene.bodies[i]->setWorldTransform(step[i].at);
      scene.bodies[i]->setLinearVelocity(step[i].linear);
      scene.bodies[i]->setAngularVelocity(step[i].angular);
    }
    scene.world.world.performDiscreteCollisionDetection();
    for (int i = 0; i < scene.world.dispatcher.getNumManifolds(); ++i)
      result.contacts += scene.world.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  }
  result.seconds = scene.world.dispatcher.seconds;
  return result;
}

double raySeconds(btCollisionShape& ground, const Options& options, std::vector<btScalar>& fractions) {
  btCollisionObject object;
  object.setCollisionShape(&ground);
  std::mt19937_64 engine(options.seed);
  fractions.clear();
  const double start = cpuSeconds();
  for (int i = 0; i < options.rays; ++i) {
    const auto at = [&] { return btScalar(test::uniform(engine, -45, 45)); };
    const btVector3 from(at(), at(), 60), to(from.x() + at(), from.y() + at(), -60);
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    btCollisionWorld::rayTestSingle(btTransform(btQuaternion::getIdentity(), from),
                                    btTransform(btQuaternion::getIdentity(), to), &object, &ground,
                                    btTransform::getIdentity(), hit);
    fractions.push_back(hit.m_closestHitFraction);
  }
  return cpuSeconds() - start;
}

void bench(double cell, const Options& options) {
  const Grounds grounds(cell, options.seed);
  const auto steps = record(grounds, options);
  const auto all = grounds.all();
  std::vector<Replay> best(all.size(), Replay{1e9, 0});
  std::vector<double> rays(all.size(), 1e9);
  std::vector<std::vector<btScalar>> fractions(all.size());
  for (int run = 0; run < options.runs; ++run)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Replay now = replay(all[i].second, steps, options);
      if (now.seconds < best[i].seconds) best[i] = now;
      rays[i] = std::min(rays[i], raySeconds(*all[i].second, options, fractions[i]));
    }
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t differ = 0;
    for (std::size_t r = 0; r < fractions[i].size(); ++r)
      differ += std::abs(fractions[i][r] - fractions[0][r]) > btScalar(1e-4) ? 1 : 0;
    fmt::print("{:<6}{:14}{:12.1f}{:8.2f}{:12.1f}{:12.3f}{:8.2f}{:8}\n", cell, all[i].first,
               1e6 * best[i].seconds / options.steps, best[i].seconds / best[0].seconds,
               double(best[i].contacts) / options.steps, 1e6 * rays[i] / options.rays, rays[i] / rays[0], differ);
  }
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  cairn::bench::Options options;
  CLI::App app("What a terrain costs the narrow phase, beside Bullet's height field and mesh");
  app.add_option("--rocks", options.rocks, "Rocks on it")->capture_default_str();
  app.add_option("--steps", options.steps, "Steps recorded and shown to each ground")->capture_default_str();
  app.add_option("--runs", options.runs, "Runs, of which the fastest counts")->capture_default_str();
  app.add_option("--rays", options.rays, "Rays a run")->capture_default_str();
  app.add_option("--cells", options.cells, "Sizes of a cell, metres")->capture_default_str();
  app.add_option("--seed", options.seed, "Of ground and rocks")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  fmt::print("{} rocks of 0.6 to 1.6 m on {} x {} m\n{:<6}{:14}{:>12}{:>8}{:>12}{:>12}{:>8}{:>8}\n", options.rocks,
             cairn::bench::kWidth, cairn::bench::kWidth, "cell", "ground", "us a step", "ratio", "contacts", "us a ray",
             "ratio", "differ");
  for (const double cell : options.cells) cairn::bench::bench(cell, options);
  return 0;
}
