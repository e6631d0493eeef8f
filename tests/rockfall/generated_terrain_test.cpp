// SPDX-License-Identifier: GPL-3.0-or-later
// Generated terrains are what was asked for; meshes as rasters; zones of materials.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/core/state_hash.h"
#include "random_tree.h"
#include "rockfall/terrain/generated.h"
#include "rockfall/terrain/mesh_raster.h"
#include "rockfall/terrain/zones.h"
#include "test_solids.h"

namespace cairn::rockfall {
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

double degreesBetween(double drop, double way) {
  return std::atan2(drop, way) * 180 / std::numbers::pi;
}

// Heights are floats of up to some hundred metres.
constexpr double kHeightTolerance = 1e-4;

TEST(GeneratedTerrain, PlaneHasTheAngleAskedFor) {
  for (const double degrees : {0.0, 10.0, 34.5, 60.0}) {
    const TerrainGrid grid =
        makePlane({.ground = {.cell = 0.5}, .length = 80, .width = 30, .degrees = degrees}).value();
    EXPECT_EQ(grid.columns, 161);
    EXPECT_EQ(grid.rows, 61);
    EXPECT_EQ(grid.origin.y, -15);
    EXPECT_NEAR(degreesBetween(heightOf(grid, 0, 7) - heightOf(grid, 160, 50), 80), degrees, 1e-4);
    EXPECT_EQ(heightOf(grid, 160, 0), 0);
    ASSERT_TRUE(bullet::TerrainShape::create(grid));
  }
}

TEST(GeneratedTerrain, SteppedSlopeHasAnglesLengthsAndBenches) {
  const SteppedSlope asked{.ground = {.cell = 0.5},
                           .length = 400,
                           .width = 40,
                           .degrees = 35,
                           .benches = 8,
                           .benchDegrees = 5,
                           .benchFraction = 0.4,
                           .shelf = 20,
                           .basin = 60};
  const TerrainGrid grid = makeSteppedSlope(asked).value();
  const auto at = [&](double x) { return heightOf(grid, static_cast<std::uint32_t>(std::lround(x / 0.5)), 10); };
  EXPECT_EQ(grid.columns, 961);
  EXPECT_NEAR(degreesBetween(at(20) - at(420), 400), 35, 1e-4);
  EXPECT_EQ(at(0), at(20)) << "the shelf is level";
  EXPECT_EQ(at(420), 0);
  EXPECT_EQ(at(480), 0) << "the basin is level";
  for (int bench = 0; bench < 8; ++bench) {
    const double begin = 20 + 50 * bench;
    EXPECT_NEAR(degreesBetween(at(begin) - at(begin + 20), 20), 5, 1e-3) << bench;
    const double riser = (std::tan(35 * std::numbers::pi / 180) - 0.4 * std::tan(5 * std::numbers::pi / 180)) / 0.6;
    EXPECT_NEAR((at(begin + 20) - at(begin + 50)) / 30, riser, 1e-5) << bench;
  }
}

TEST(GeneratedTerrain, TalusConeIsRoundAndHasTheAngleAskedFor) {
  const TerrainGrid grid = makeTalusCone({.ground = {.cell = 1}, .radius = 50, .degrees = 34, .basin = 20}).value();
  const double slope = std::tan(34 * std::numbers::pi / 180);
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const double r = std::hypot(column, row - 70.0);
      ASSERT_NEAR(heightOf(grid, column, row), slope * std::max(50 - r, 0.0), kHeightTolerance);
    }
}

// R15 needs it exact: heights with their roughness, and what is between them.
TEST(GeneratedTerrain, ChannelIsItsOwnMirrorImage) {
  const TerrainGrid grid =
      makeChannel({.ground = {.cell = 0.7, .roughness = 0.2, .seed = 5}, .length = 100, .width = 40}).value();
  ASSERT_EQ(grid.rows % 2, 1);
  ASSERT_EQ((grid.rows - 1) % 2, 0) << "an even number of rows of cells";
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column)
      ASSERT_EQ(heightOf(grid, column, row), heightOf(grid, column, grid.rows - 1 - row));
  const auto shape = bullet::TerrainShape::create(grid).value();
  EXPECT_EQ(shape->origin().y, 0);
  std::mt19937_64 engine(70);
  for (int trial = 0; trial < 2000; ++trial) {
    const double x = uniform(engine, double(shape->lower().x()), double(shape->upper().x()));
    const double y = uniform(engine, 0, double(shape->upper().y()));
    // Some roundings of heights below 64 m, in another order.
    ASSERT_NEAR(*shape->heightAt(x, y), *shape->heightAt(x, -y), 1e-12);
  }
  EXPECT_NEAR(
      degreesBetween(heightOf(grid, 0, (grid.rows - 1) / 2) - heightOf(grid, grid.columns - 1, (grid.rows - 1) / 2),
                     0.7 * (grid.columns - 1)),
      20, 0.4)
      << "but for the roughness";
}

TEST(GeneratedTerrain, TheSameSeedGivesTheSameBits) {
  const auto rough = [](std::uint64_t seed) {
    return makeSteppedSlope({.ground = {.cell = 1, .roughness = 0.3, .seed = seed}, .length = 100, .width = 30})
        .value();
  };
  EXPECT_EQ(hashOf(rough(1)), hashOf(rough(1)));
  EXPECT_NE(hashOf(rough(1)), hashOf(rough(2)));
  const TerrainGrid smooth = makeSteppedSlope({.ground = {.cell = 1}, .length = 100, .width = 30}).value();
  const TerrainGrid uneven = rough(3);
  double most = 0;
  for (std::size_t i = 0; i < smooth.heights.size(); ++i)
    most = std::max(most, std::abs(double(uneven.heights[i]) - double(smooth.heights[i])));
  EXPECT_LE(most, 0.3 + kHeightTolerance);
  EXPECT_GT(most, 0.29);
}

TEST(GeneratedTerrain, RefusesWhatCannotBe) {
  const auto message = [](const auto& made) { return made ? std::string("accepted") : made.error().message; };
  EXPECT_EQ(message(makePlane({.length = -3})),
            "a generated terrain's length is -3.000000 m: give a finite one greater than 0");
  EXPECT_EQ(message(makePlane({.degrees = 90})), "a generated terrain's angle is 90.000000 degrees: give 0 to 85");
  EXPECT_EQ(message(makePlane({.ground = {.cell = std::nan("")}})),
            "a generated terrain's cell is nan m: give a finite one greater than 0");
  EXPECT_EQ(message(makePlane({.ground = {.roughness = -1}})),
            "a generated terrain's roughness is -1.000000 m: give a finite one that is not negative");
  EXPECT_EQ(
      message(makePlane({.ground = {.cell = 1e-6}, .length = 1000, .width = 1})),
      "a generated terrain has 1000000001 x 1000001 values: give at least one, and at most 2^20 a side and 2^28 in "
      "all");
  EXPECT_EQ(message(makeSteppedSlope({.benches = 0})),
            "a stepped slope has no benches: give at least one, or use a plane");
  EXPECT_EQ(message(makeSteppedSlope({.degrees = 10, .benchDegrees = 20})),
            "a stepped slope's benches are steeper than the slope: give an angle of at most 10.000000 degrees");
  EXPECT_EQ(message(makeSteppedSlope({.degrees = 80, .benchFraction = 0.9})),
            "a stepped slope's risers would be steeper than 85 degrees: give benches less of its length");
  EXPECT_EQ(message(makeSteppedSlope({.benchFraction = 1})),
            "a stepped slope's benches take 1.000000 of its length: give more than 0 and less than 1");
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

TEST(MaterialZones, AreThoseTheMiddlesOfCellsAreIn) {
  TerrainGrid grid;
  grid.columns = 11;
  grid.rows = 9;
  grid.cell = 2;
  grid.origin = {100, -50, 0};
  grid.heights.assign(99, 0);
  const std::vector<MaterialZone> zones = {{1, {{{103, -45}}, {{111, -45}}, {{111, -39}}, {{103, -39}}}},
                                           {2, {{{105, -45}}, {{125, -45}}, {{105, -25}}}}};
  const auto materials = materialsOfCells(grid, 7, zones);
  ASSERT_EQ(materials.size(), 80);
  for (std::uint32_t row = 0; row < 8; ++row)
    for (std::uint32_t column = 0; column < 10; ++column) {
      const double x = 101 + 2.0 * column, y = -49 + 2.0 * row;
      const bool inSecond = x >= 105 && y >= -45 && x + y < 80;
      const bool inFirst = x >= 103 && x < 111 && y >= -45 && y < -39;
      EXPECT_EQ(materials[row * 10 + column], inSecond ? 2 : inFirst ? 1 : 7) << x << " " << y;
    }
}

// A square cut along a random line: every point belongs to exactly one part.
TEST(MaterialZones, SharedBordersBelongToOneSide) {
  std::mt19937_64 engine(71);
  for (int trial = 0; trial < 200; ++trial) {
    const double low = uniform(engine, 1, 9), high = uniform(engine, 1, 9);
    const std::vector<std::array<double, 2>> left = {{0, 0}, {low, 0}, {high, 10}, {0, 10}};
    const std::vector<std::array<double, 2>> right = {{high, 10}, {low, 0}, {10, 0}, {10, 10}};
    for (int point = 0; point < 200; ++point) {
      const double y = uniform(engine, 0, 10);
      const double x = point % 2 == 0 ? low + y / 10 * (high - low) : uniform(engine, 0, 10);
      ASSERT_NE(isInside(left, x, y), isInside(right, x, y));
    }
  }
  EXPECT_FALSE(isInside({}, 0, 0));
}

}  // namespace
}  // namespace cairn::rockfall
