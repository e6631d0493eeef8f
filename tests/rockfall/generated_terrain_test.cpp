// SPDX-License-Identifier: GPL-3.0-or-later
// Generated terrains are what was asked for; meshes as rasters.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/core/state_hash.h"
#include "random_tree.h"
#include "rockfall/terrain/generated.h"
#include "rockfall/terrain/mesh_raster.h"
#include "test_solids.h"

namespace cairn::rockfall::generated_terrain_test {
namespace {

using bullet::TerrainGrid;
using test::uniform;

double heightOf(const TerrainGrid& grid, std::uint32_t column, std::uint32_t row) {
  return double(grid.heights[std::size_t(row) * grid.columns + column]);
}

std::uint64_t hashOf(const TerrainGrid& grid) {
  StateHash hash;
  for (const float height : grid.heights) hash.add(height);
  return hash.value();
}

constexpr std::uint64_t kSeed = 1;

double slopeOf(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

// Heights below 128 m and slopes are both rounded to float: by 2^-18 m, and by 2^-25 of two over 80 m.
constexpr double kHeightTolerance = 1e-5;

TEST(GeneratedTerrain, PlaneHasTheAngleAskedFor) {
  for (const double degrees : {0.0, 10.0, 34.5, 55.0}) {
    const TerrainGrid grid = generateTerrain(PlaneTerrain{{30, 0.5, 0}, 80, degrees}, kSeed).value();
    EXPECT_EQ(grid.columns, 161);
    EXPECT_EQ(grid.rows, 61);
    EXPECT_EQ(grid.origin.x, 0);
    EXPECT_EQ(grid.origin.y, -15);
    EXPECT_NEAR(heightOf(grid, 0, 7) - heightOf(grid, 160, 50), 80 * slopeOf(degrees), kHeightTolerance);
    EXPECT_EQ(heightOf(grid, 160, 0), 0);
    ASSERT_TRUE(bullet::TerrainShape::create(grid));
  }
}

TEST(GeneratedTerrain, CoversWhatIsAskedForByWholeCellsAndAnEvenNumberAcross) {
  for (const double cell : {0.7, 1.0, 3.0, 100.0}) {
    const TerrainGrid grid = generateTerrain(PlaneTerrain{{31, cell, 0}, 80, 20}, kSeed).value();
    EXPECT_EQ(grid.rows % 2, 1) << cell;
    EXPECT_EQ(heightOf(grid, 3 % grid.columns, 0), heightOf(grid, 3 % grid.columns, grid.rows - 1));
    EXPECT_EQ(grid.origin.y, -cell * (grid.rows - 1) / 2);
    EXPECT_GE(cell * (grid.rows - 1), 31);
    EXPECT_LT(cell * (grid.rows - 1), 31 + 2 * cell);
    EXPECT_GE(cell * (grid.columns - 1), 80);
    EXPECT_LT(cell * (grid.columns - 1), 80 + cell);
  }
}

TEST(GeneratedTerrain, SteppedSlopeFollowsItsProfileBetweenItsBanks) {
  const SteppedSlopeTerrain asked{{40, 0.5, 0}, {{-10, 60}, {10, 58}, {20, 20}, {50, 15}, {80, 15}}, 4};
  const TerrainGrid grid = generateTerrain(asked, kSeed).value();
  EXPECT_EQ(grid.columns, 181);
  EXPECT_EQ(grid.origin.x, -10);
  EXPECT_EQ(grid.origin.y, -21.5) << "a metre of bank and a cell";
  const auto at = [&](double x, double y) {
    return heightOf(grid, static_cast<std::uint32_t>(std::lround((x + 10) / 0.5)),
                    static_cast<std::uint32_t>(std::lround((y + 21.5) / 0.5)));
  };
  for (const double y : {-20.0, 0.0, 13.5, 20.0}) {
    EXPECT_EQ(at(-10, y), 60);
    EXPECT_EQ(at(10, y), 58);
    EXPECT_NEAR(at(15, y), 39, kHeightTolerance);
    EXPECT_NEAR(at(30, y), 20 - 5.0 / 3, kHeightTolerance);
    EXPECT_EQ(at(70, y), 15);
  }
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(at(70, side * 20.5), 15 + 2);
    EXPECT_EQ(at(70, side * 21), 15 + 4);
    EXPECT_EQ(at(70, side * 21.5), 15 + 4);
  }
}

TEST(GeneratedTerrain, TalusConeIsRoundAndHasTheAngleAskedFor) {
  const TerrainGrid grid = generateTerrain(TalusConeTerrain{{140, 1, 0}, 34, 34}, kSeed).value();
  ASSERT_EQ(grid.columns, 141);
  ASSERT_EQ(grid.rows, 141);
  EXPECT_EQ(grid.origin.x, -70);
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const double r = std::hypot(column - 70.0, row - 70.0);
      ASSERT_NEAR(heightOf(grid, column, row), std::max(34 - slopeOf(34) * r, 0.0), kHeightTolerance);
    }
}

// A drop in its middle must fall straight (R15): heights with their roughness, and what is between them.
TEST(GeneratedTerrain, ChannelIsItsOwnMirrorImage) {
  const double depth = 8, half = 20;
  const ChannelTerrain asked{{2 * half, 0.7, 0.2}, 100, 20, depth};
  const TerrainGrid grid = generateTerrain(asked, 5).value();
  ASSERT_EQ((grid.rows - 1) % 2, 0) << "an even number of rows of cells";
  ChannelTerrain even = asked;
  even.grid.roughnessM = 0;
  const TerrainGrid smooth = generateTerrain(even, 5).value();
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      ASSERT_EQ(heightOf(grid, column, row), heightOf(grid, column, grid.rows - 1 - row));
      const double x = 0.7 * column, y = grid.origin.y + 0.7 * row;
      ASSERT_NEAR(heightOf(smooth, column, row), (100 - x) * slopeOf(20) + depth * y * y / (half * half),
                  kHeightTolerance);
    }
  const auto shape = bullet::TerrainShape::create(grid).value();
  EXPECT_EQ(shape->origin().y, 0);
  std::mt19937_64 engine(70);
  for (int trial = 0; trial < 2000; ++trial) {
    const double x = uniform(engine, double(shape->lower().x()), double(shape->upper().x()));
    const double y = uniform(engine, 0, double(shape->upper().y()));
    // Some roundings of heights below 64 m, in another order.
    ASSERT_NEAR(*shape->heightAt(x, y), *shape->heightAt(x, -y), 1e-12);
  }
}

TEST(GeneratedTerrain, TheSameSeedGivesTheSameBits) {
  const auto rough = [](std::uint64_t seed, double by) {
    return generateTerrain(SteppedSlopeTerrain{{30, 1, by}, {{0, 50}, {100, 0}}, 0}, seed).value();
  };
  EXPECT_EQ(hashOf(rough(1, 0.3)), hashOf(rough(1, 0.3)));
  EXPECT_NE(hashOf(rough(1, 0.3)), hashOf(rough(2, 0.3)));
  const TerrainGrid smooth = rough(1, 0), uneven = rough(3, 0.3);
  double most = 0;
  for (std::size_t i = 0; i < smooth.heights.size(); ++i)
    most = std::max(most, std::abs(double(uneven.heights[i]) - double(smooth.heights[i])));
  EXPECT_LE(most, 0.3 + kHeightTolerance);
  EXPECT_GT(most, 0.29);
}

TEST(GeneratedTerrain, RefusesTooManyPoints) {
  const auto message = [](const auto& made) { return made ? std::string("accepted") : made.error().message; };
  EXPECT_EQ(message(generateTerrain(PlaneTerrain{{100, 0.01, 0}, 1e5, 30}, kSeed)),
            "/terrain: a generated grid has 10000001 x 10001 values: give at least one, and at most 2^20 a side and "
            "2^28 in all; use a larger cell_m");
  EXPECT_EQ(message(generateTerrain(ChannelTerrain{{1e3, 0.01, 0}, 1e3, 30, 5}, kSeed)),
            "/terrain: a generated grid has 100001 x 100001 values: give at least one, and at most 2^20 a side and "
            "2^28 in all; use a larger cell_m");
}

builder::TriangleMesh meshOf(const test::Solid& solid) {
  builder::TriangleMesh mesh;
  mesh.vertices = solid.vertices;
  mesh.triangles = {solid.triangles.begin(), solid.triangles.end()};
  return mesh;
}

// A roof with its corners between the points of the raster, and a lid over a part of it.
TEST(MeshRaster, TakesTheTopmostSurface) {
  builder::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {5, 0, 3}, {0, 8, 0}, {10, 8, 0}, {5, 8, 3}, {1, 1, 7}, {3, 1, 7}, {3, 3, 7}};
  mesh.triangles = {{0, 2, 5}, {0, 5, 3}, {2, 1, 4}, {2, 4, 5}, {6, 7, 8}};
  const double cell = 0.3;
  const Raster raster = rasterOfMesh(mesh, cell).value();
  EXPECT_EQ(raster.columns, 34);
  EXPECT_EQ(raster.rows, 27);
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const double x = column * cell, y = row * cell;
      const bool isUnderLid = x <= 3 + 1e-9 && y >= 1 - 1e-9 && y <= x + 1e-9 && x >= 1;
      ASSERT_NEAR(raster.at(column, row), isUnderLid ? 7 : 3 - 0.6 * std::abs(x - 5), 1e-8) << x << " " << y;
    }
}

// A ball's facets lie between it and the largest ball inside them.
TEST(MeshRaster, HasNoValueBesideTheMeshAndNoneMissingOnIt) {
  const builder::TriangleMesh mesh = meshOf(test::ball(5, 12));
  double inner = 5;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    inner = std::min(inner, dot(normalized(cross(b - a, c - a)), a));
  }
  ASSERT_GT(inner, 4.9);
  const Raster raster = rasterOfMesh(mesh, 0.25).value();
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const double r = std::hypot(raster.x + column * 0.25, raster.y + row * 0.25);
      if (r > 5 + 1e-9) {
        ASSERT_TRUE(std::isnan(raster.at(column, row)));
      } else if (r < inner) {
        ASSERT_LE(raster.at(column, row), std::sqrt(25 - r * r) + 1e-9);
        ASSERT_GE(raster.at(column, row), std::sqrt(inner * inner - r * r) - 1e-9);
      }
    }
}

TEST(MeshRaster, RefusesWhatCannotBeSampled) {
  const builder::TriangleMesh mesh = meshOf(test::cuboid({1, 1, 1}, 1));
  EXPECT_EQ(rasterOfMesh(mesh, 0).error().message, "cannot be sampled every 0.000000 m: give a positive, finite cell");
  EXPECT_EQ(rasterOfMesh(mesh, 1e-9).error().message,
            "has 1000000001 x 1000000001 values: give at least one, and at most 2^20 a side and 2^28 in all");
  EXPECT_FALSE(rasterOfMesh({}, 1));
  EXPECT_FALSE(readMeshRaster("no such file.obj", 1));
}

}  // namespace
}  // namespace cairn::rockfall::generated_terrain_test
