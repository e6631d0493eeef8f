// SPDX-License-Identifier: Zlib
// Rays and convex sweeps at a terrain: the same hits as from all triangles one by one, of which few are asked.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "bullet_world.h"
#include "casts.h"
#include "ray_hits.h"
#include "terrains.h"

namespace cairn::test::terrain_cast_test {
namespace {

using bullet::TerrainGrid;
using bullet::TerrainShape;

// Above, through and beside the terrain; some from two hundred of its sizes away.
Way randomWayAt(std::mt19937_64& engine, const TerrainShape& shape) {
  return randomWay(engine, double((shape.upper() - shape.lower()).length()), std::pow(10, uniform(engine, -1, 2.3)));
}

// Along rows, columns, diagonals and straight down, from point to point.
Way wayOnGrid(std::mt19937_64& engine, const TerrainShape& shape) {
  const TerrainGrid& grid = shape.grid();
  const auto onAxis = [&](std::uint32_t count) {
    return (static_cast<double>(engine() % count) - 0.5 * (count - 1)) * grid.cell;
  };
  const double high = double(shape.upper().z()) + 1;
  const Vec3d from(onAxis(grid.columns), onAxis(grid.rows), high);
  Vec3d to(engine() % 2 ? from.x : onAxis(grid.columns), engine() % 2 ? from.y : onAxis(grid.rows), -high);
  if (engine() % 3 == 0) to.z = high - 2;
  return {toBt(from), toBt(to)};
}

TEST(TerrainRay, FindsWhatAllTrianglesGive) {
  constexpr std::uint64_t kSeed = 40;
  std::mt19937_64 engine(kSeed);
  RayTotals totals;
  for (int terrain = 0; terrain < 12; ++terrain) {
    TerrainGrid grid = randomTerrain(
        engine, {40 + static_cast<std::uint32_t>(engine() % 20), 50, std::pow(10, uniform(engine, -1, 1))},
        terrain % 3 == 0 ? 50 : 0);
    grid.diagonals = kEveryDiagonals[terrain % 3];
    const auto shape = terrainOf(std::move(grid));
    for (int trial = 0; trial < 500; ++trial) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", terrain " + std::to_string(terrain) + ", trial " +
                   std::to_string(trial));
      const Way way = trial % 3 == 0 ? wayOnGrid(engine, *shape) : randomWayAt(engine, *shape);
      expectSameHits(*shape, way, static_cast<unsigned>(engine() % 4), trial % 2 == 0, totals);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(totals.hits, totals.rays / 4);
  std::printf("%zu rays, %zu hit; %.1f triangles asked a ray, of %.0f\n", totals.rays, totals.hits,
              double(totals.asked) / double(totals.rays), double(totals.triangles) / double(totals.rays));
}

// A level ray meets, of each row it crosses, the columns it crosses there: together no more than rows and columns and
// one more. Two triangles each, and twice that for rays within the tolerance of a border.
TEST(TerrainRay, AsksNoMoreThanTheCellsOnItsWay) {
  constexpr std::uint64_t kSeed = 41;
  std::mt19937_64 engine(kSeed);
  for (const std::uint32_t points : {64U, 256U, 1024U}) {
    const auto shape =
        terrainOf(terrainGrid({points, points, 1}, [&](double, double) { return uniform(engine, -1, 1); }));
    RayTotals totals;
    for (int trial = 0; trial < 20; ++trial) {
      const double half = 0.6 * points;
      const Way way{btVector3(btScalar(-half), btScalar(uniform(engine, -half, half)), 0),
                    btVector3(btScalar(half), btScalar(uniform(engine, -half, half)), 0)};
      RayHits hits(way, 0, true);
      shape->processAllTriangles(&hits, way.from, way.to);
      EXPECT_LE(hits.asked, 4 * (2 * points + 1));
      totals.asked += hits.asked;
    }
    EXPECT_GT(totals.asked, 20 * points / 2) << "no ray went through anything";
  }
}

// High above the ground nothing is asked.
TEST(TerrainRay, AsksNothingAboveTheGround) {
  std::mt19937_64 engine(42);
  const auto shape = terrainOf(randomTerrain(engine, {500, 500, 1}));
  const btScalar high = shape->upper().z() + 1;
  RayHits hits({btVector3(-300, -200, high), btVector3(300, 250, high)}, 0, true);
  shape->processAllTriangles(&hits, hits.m_from, hits.m_to);
  EXPECT_EQ(hits.asked, 0);
}

TEST(TerrainRay, WorksThroughAWorld) {
  BulletWorld<> w;
  const auto shape = terrainOf(terrainGrid({101, 101, 1}, [](double x, double) { return 0.1 * x; }));
  w.add(shape, 0, btVector3(7, 8, 9));
  const btVector3 from(17, 8, 100), to(17, 8, -100);
  btCollisionWorld::ClosestRayResultCallback closest(from, to);
  w.world.rayTest(from, to, closest);
  ASSERT_TRUE(closest.hasHit());
  EXPECT_NEAR(double(closest.m_hitPointWorld.z()), 9 + *shape->heightAt(10, 0), 1e-3);
  EXPECT_GT(closest.m_hitNormalWorld.z(), 0.99);
}

struct SweepHits final : btTriangleConvexcastCallback {
  using btTriangleConvexcastCallback::btTriangleConvexcastCallback;
  btScalar reportHit(const btVector3& normal, const btVector3&, btScalar fraction, int part, int triangle) override {
    hits.push_back({fraction, part, triangle, normal});
    return 1;  // wants them all
  }
  void processTriangle(btVector3* triangle, int part, int index) override {
    btTriangleConvexcastCallback::processTriangle(triangle, part, index);
  }
  std::vector<Hit> hits;
};

TEST(TerrainSweep, FindsWhatAllTrianglesGive) {
  constexpr std::uint64_t kSeed = 43;
  std::mt19937_64 engine(kSeed);
  std::size_t hits = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    TerrainGrid grid = randomTerrain(engine, {20, 24, 1}, trial % 3 == 0 ? 50 : 0);
    const auto shape = terrainOf(std::move(grid));
    const btSphereShape sphere(btScalar(uniform(engine, 0.1, 2)));
    const btBoxShape box(btVector3(btScalar(0.3), btScalar(0.8), btScalar(0.5)));
    const btConvexShape& mover = trial % 2 == 0 ? static_cast<const btConvexShape&>(sphere) : box;
    const Way way = randomWay(engine, 20, uniform(engine, 0.2, 3));
    const btTransform world = randomTransform(engine), turned = randomTransform(engine);
    const bool turns = trial % 4 == 0;
    const btTransform from(turned.getBasis(), world * way.from);
    const btTransform to(turns ? randomTransform(engine).getBasis() : turned.getBasis(), world * way.to);
    SweepHits fast(&mover, from, to, world, shape->getMargin()), slow(&mover, from, to, world, shape->getMargin());
    shape->processAllTriangles(&fast, way.from, way.to);
    castOverAll(*shape, slow);
    std::sort(fast.hits.begin(), fast.hits.end());
    std::sort(slow.hits.begin(), slow.hits.end());
    ASSERT_TRUE(fast.hits == slow.hits) << fast.hits.size() << " hits instead of " << slow.hits.size();
    hits += slow.hits.empty() ? 0 : 1;
  }
  EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace cairn::test::terrain_cast_test
