// SPDX-License-Identifier: Zlib
// The triangles of a terrain: which a box meets, how many cells are looked at for it, what is refused.
#include <gtest/gtest.h>

#include <LinearMath/btAabbUtil2.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "casts.h"
#include "terrain/terrain_lattice.h"
#include "terrains.h"

namespace cairn::test::terrain_test {
namespace {

using bullet::TerrainDiagonals;
using bullet::TerrainGrid;
using bullet::TerrainLattice;
using bullet::TerrainShape;

struct Found {
  int part, index;
  std::array<btVector3, 3> corners;
};

struct Collect final : btTriangleCallback {
  void processTriangle(btVector3* t, int part, int index) override {
    found.push_back({part, index, {t[0], t[1], t[2]}});
  }
  std::vector<Found> found;
};

std::vector<Found> trianglesIn(const TerrainShape& shape, const btVector3& lower, const btVector3& upper) {
  Collect collect;
  shape.processAllTriangles(&collect, lower, upper);
  return collect.found;
}

std::vector<Found> allTriangles(const TerrainShape& shape) {
  Collect collect;
  castOverAll(shape, collect);
  return collect.found;
}

// Straight from the definition of a grid, point by point, with nothing of the lattice.
std::vector<Found> byDefinition(const TerrainGrid& grid) {
  std::vector<Found> all;
  const auto point = [&](std::uint32_t column, std::uint32_t row) {
    return btVector3(btScalar((column - 0.5 * (grid.columns - 1)) * grid.cell),
                     btScalar((row - 0.5 * (grid.rows - 1)) * grid.cell),
                     btScalar(grid.heights[row * grid.columns + column]));
  };
  for (std::uint32_t row = 0; row + 1 < grid.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < grid.columns; ++column) {
      const btVector3 a = point(column, row), b = point(column + 1, row), c = point(column + 1, row + 1),
                      d = point(column, row + 1);
      const bool rises = grid.diagonals == TerrainDiagonals::rising ||
                         (grid.diagonals == TerrainDiagonals::alternating && (column + row) % 2 == 0);
      const int index = static_cast<int>(2 * (row * (grid.columns - 1) + column));
      const std::array<Found, 2> both = {Found{0, index, {a, b, rises ? c : d}},
                                         Found{0, index + 1, {rises ? a : b, c, d}}};
      for (const Found& f : both)
        if (!std::isnan(f.corners[0].z() + f.corners[1].z() + f.corners[2].z())) all.push_back(f);
    }
  return all;
}

void expectSame(std::vector<Found> found, const std::vector<Found>& expected) {
  std::ranges::sort(found, {}, &Found::index);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].part, 0);
    ASSERT_EQ(found[i].index, expected[i].index);
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(found[i].corners[corner][axis], expected[i].corners[corner][axis]);
  }
}

TerrainSize randomSize(std::mt19937_64& engine) {
  return {2 + static_cast<std::uint32_t>(engine() % 70), 2 + static_cast<std::uint32_t>(engine() % 70),
          std::pow(10, uniform(engine, -2, 2))};
}

// Some with corners and faces exactly on the grid's, or beyond all of it.
btVector3 randomCorner(std::mt19937_64& engine, const TerrainShape& shape) {
  const TerrainGrid& grid = shape.grid();
  btVector3 at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = btScalar(uniform(engine, 1.2 * double(shape.lower()[axis]), 1.2 * double(shape.upper()[axis])));
  if (engine() % 4 == 0)
    at.setX(btScalar((static_cast<double>(engine() % grid.columns) - 0.5 * (grid.columns - 1)) * grid.cell));
  if (engine() % 4 == 0)
    at.setY(btScalar((static_cast<double>(engine() % grid.rows) - 0.5 * (grid.rows - 1)) * grid.cell));
  if (engine() % 8 == 0)
    if (const float height = grid.heights[engine() % grid.heights.size()]; !std::isnan(height))
      at.setZ(btScalar(height));
  return at;
}

TEST(Terrain, GivesABoxWhatAllTrianglesOneByOneWould) {
  constexpr std::uint64_t kSeed = 30;
  std::mt19937_64 engine(kSeed);
  std::size_t given = 0, whole = 0;
  for (int trial = 0; trial < 60; ++trial) {
    TerrainGrid grid = randomTerrain(engine, randomSize(engine), trial % 3 == 0 ? 60 : 0);
    grid.diagonals = kEveryDiagonals[engine() % 3];
    const auto shape = terrainOf(grid);
    const std::vector<Found> all = byDefinition(grid);
    for (int box = 0; box < 60; ++box) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", box " +
                   std::to_string(box));
      btVector3 lower = randomCorner(engine, *shape), upper = lower;
      const btVector3 other = randomCorner(engine, *shape);
      const btScalar part = btScalar(std::pow(10, uniform(engine, -2, 0)));
      lower.setMin(lower + (other - lower) * part);
      upper.setMax(upper + (other - upper) * part);
      std::vector<Found> expected;
      for (const Found& f : all)
        if (TestTriangleAgainstAabb2(f.corners.data(), lower, upper)) expected.push_back(f);
      expectSame(trianglesIn(*shape, lower, upper), expected);
      if (testing::Test::HasFatalFailure()) return;
      given += expected.size();
      whole += all.size();
    }
  }
  EXPECT_GT(given, whole / 200);
  EXPECT_LT(given, whole / 2);
}

TEST(Terrain, GivesEverythingToEndlessBoxesAndNothingToNone) {
  std::mt19937_64 engine(31);
  const auto shape = terrainOf(randomTerrain(engine, {40, 35, 0.7}, 30));
  const std::vector<Found> all = byDefinition(shape->grid());
  const btScalar infinity = std::numeric_limits<btScalar>::infinity(),
                 nothing = std::numeric_limits<btScalar>::quiet_NaN();
  for (const btScalar far : {btScalar(1e9), btScalar(1e30), infinity})
    expectSame(trianglesIn(*shape, btVector3(-far, -far, -far), btVector3(far, far, far)), all);
  EXPECT_TRUE(trianglesIn(*shape, btVector3(nothing, 0, 0), btVector3(1, 1, 1)).empty());
  EXPECT_TRUE(trianglesIn(*shape, btVector3(0, 0, nothing), btVector3(1, 1, 1)).empty());
  EXPECT_TRUE(trianglesIn(*shape, btVector3(1, 1, 1), btVector3(-1, -1, -1)).empty());
}

// A width w meets floor(w / cell) + 2 cells at most; one more where an end is on a border, by the closed box.
TEST(Terrain, LooksAtNoMoreCellsThanLieBelowTheBox) {
  constexpr std::uint64_t kSeed = 32;
  std::mt19937_64 engine(kSeed);
  const TerrainSize size{300, 200, 0.5};
  const TerrainLattice lattice(randomTerrain(engine, size));
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double w = std::pow(10, uniform(engine, -2, 1.5)), d = std::pow(10, uniform(engine, -2, 1.5));
    const btVector3 lower(btScalar(uniform(engine, -80, 80)), btScalar(uniform(engine, -55, 55)), -100);
    std::int64_t cells = 0;
    lattice.forEachCell(lower, lower + btVector3(btScalar(w), btScalar(d), 200), [&](auto, auto) { ++cells; });
    const auto bound = [&](double width) { return static_cast<std::int64_t>(std::floor(width / size.cell)) + 3; };
    ASSERT_LE(cells, bound(w) * bound(d));
  }
}

// Of blocks that lie wholly above or below the box no cell is looked at: above a cliff's foot, none of the plateau.
TEST(Terrain, SkipsBlocksAboveAndBelowTheBox) {
  const double edge = 2 * TerrainLattice::kBlock;
  const TerrainLattice lattice(terrainGrid({257, 65, 1}, [&](double x, double) { return x <= edge ? 50 : 0; }));
  const auto cellsBetween = [&](btScalar low, btScalar high) {
    std::int64_t cells = 0;
    lattice.forEachCell(btVector3(-1000, -1000, low), btVector3(1000, 1000, high), [&](auto, auto) { ++cells; });
    return cells;
  };
  // Between foot and plateau lies only the block column that the cliff goes through.
  EXPECT_EQ(cellsBetween(1, 49), TerrainLattice::kBlock * 64);
  EXPECT_EQ(cellsBetween(-2, -1), 0);
  EXPECT_EQ(cellsBetween(51, 60), 0);
  EXPECT_EQ(cellsBetween(-1, 60), 256 * 64);
}

TEST(Terrain, NeighboursShareCornersAndFaceUpwards) {
  std::mt19937_64 engine(33);
  for (const TerrainDiagonals diagonals : kEveryDiagonals) {
    TerrainGrid grid = randomTerrain(engine, {21, 18, 1.0 / 3});
    grid.diagonals = diagonals;
    using Point = std::array<btScalar, 3>;
    std::map<std::pair<Point, Point>, int> edges;
    for (const Found& f : allTriangles(*terrainOf(grid))) {
      EXPECT_GT((f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]).z(), 0);
      for (std::size_t i = 0; i < 3; ++i) {
        const btVector3 &p = f.corners[i], &q = f.corners[(i + 1) % 3];
        ++edges[{{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z()}}];
      }
    }
    int unpaired = 0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      if (!edges.contains({edge.second, edge.first})) ++unpaired;
    }
    EXPECT_EQ(unpaired, 2 * (20 + 17)) << "edges without a neighbour, of which the border has so many";
  }
}

TEST(Terrain, AlternatingDiagonalsAreMirroredWithTheGrid) {
  std::mt19937_64 engine(34);
  TerrainGrid grid = randomTerrain(engine, {12, 9, 0.7}), mirrored = grid;  // 8 rows of cells
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column)
      mirrored.heights[row * grid.columns + column] = grid.heights[(grid.rows - 1 - row) * grid.columns + column];
  const auto shape = terrainOf(grid), other = terrainOf(mirrored);
  for (int trial = 0; trial < 500; ++trial) {
    const double x = uniform(engine, -3.8, 3.8), y = uniform(engine, -2.7, 2.7);
    // The corners come in another order: some roundings of heights below ten metres.
    EXPECT_NEAR(*shape->heightAt(x, y), *other->heightAt(x, -y), 1e-13);
  }
}

TEST(Terrain, HeightAndNormalAreThoseOfTheTriangleBelow) {
  constexpr std::uint64_t kSeed = 35;
  std::mt19937_64 engine(kSeed);
  for (const TerrainDiagonals diagonals : kEveryDiagonals) {
    TerrainGrid grid = randomTerrain(engine, {30, 40, 0.8}, 100);
    grid.diagonals = diagonals;
    const auto shape = terrainOf(grid);
    const std::vector<Found> all = allTriangles(*shape);
    int holes = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      const double x = uniform(engine, -11, 11), y = uniform(engine, -15, 15);
      const auto isOver = [&](const Found& f) {
        for (std::size_t i = 0; i < 3; ++i) {
          const btVector3 edge = f.corners[(i + 1) % 3] - f.corners[i];
          if (double(edge.x()) * (y - double(f.corners[i].y())) - double(edge.y()) * (x - double(f.corners[i].x())) < 0)
            return false;
        }
        return true;
      };
      const auto below = std::ranges::find_if(all, isOver);
      const std::optional<double> height = shape->heightAt(x, y);
      const std::optional<btVector3> normal = shape->normalAt(x, y);
      ASSERT_EQ(height.has_value(), below != all.end()) << "seed " << kSeed;
      ASSERT_EQ(normal.has_value(), height.has_value());
      if (!height) {
        ++holes;
        continue;
      }
      const btVector3 n =
          (below->corners[1] - below->corners[0]).cross(below->corners[2] - below->corners[0]).normalized();
      const btVector3 off = btVector3(btScalar(x), btScalar(y), btScalar(*height)) - below->corners[0];
      // Single precision of coordinates up to 16 m.
      EXPECT_NEAR(double(off.dot(n)), 0, 1e-5);
      EXPECT_NEAR(double((*normal - n).length()), 0, 1e-5);
    }
    EXPECT_GT(holes, 100);
  }
  const auto flat = flatTerrain(TerrainDiagonals::rising, {3, 3, 1});
  EXPECT_TRUE(flat->heightAt(1, 1).has_value()) << "the border belongs to it";
  EXPECT_FALSE(flat->heightAt(1.01, 0).has_value());
  EXPECT_FALSE(flat->normalAt(0, -1.01).has_value());
}

TEST(Terrain, NamesItsTriangles) {
  TerrainGrid grid = terrainGrid({7, 5, 1}, [](double, double) { return 0; });
  const auto shape = terrainOf(grid);
  for (const Found& f : allTriangles(*shape)) {
    const bullet::TerrainTriangle named = bullet::terrainTriangle(grid, f.index);
    EXPECT_EQ(named.index(grid), f.index);
    const btVector3 middle = (f.corners[0] + f.corners[1] + f.corners[2]) / 3;
    EXPECT_EQ(named.column, static_cast<std::uint32_t>(std::floor(double(middle.x()) + 3)));
    EXPECT_EQ(named.row, static_cast<std::uint32_t>(std::floor(double(middle.y()) + 2)));
    EXPECT_EQ(named.isUpper, double(middle.y()) + 2 - named.row > 0.5);
  }
}

// Ten kilometres of map from its origin, at coordinates that float cannot hold.
TEST(Terrain, KeepsAMapsCoordinatesInDouble) {
  TerrainGrid grid = terrainGrid({1001, 801, 10}, [](double x, double) { return 0.25 * x; });
  grid.origin = {2600000.25, 1200000.5, 1834};
  const auto shape = terrainOf(grid);
  EXPECT_EQ(shape->origin().x, 2600000.25 + 5000);
  EXPECT_EQ(shape->origin().y, 1200000.5 + 4000);
  EXPECT_EQ(shape->origin().z, 1834);
  EXPECT_NEAR(*shape->heightAt(2603334.5 - shape->origin().x, 0), 0.25 * (2603334.5 - grid.origin.x),
              2500 * double(std::numeric_limits<float>::epsilon()));
}

std::string refusal(TerrainGrid grid) {
  const auto shape = TerrainShape::create(std::move(grid));
  return shape ? "accepted" : shape.error().message;
}

TEST(Terrain, RefusesWhatIsNoTerrain) {
  const TerrainGrid good = terrainGrid({3, 2, 1}, [](double x, double) { return x; });
  EXPECT_EQ(refusal(good), "accepted");
  const auto with = [&](auto change) {
    TerrainGrid grid = good;
    change(grid);
    return refusal(std::move(grid));
  };
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNone = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(with([](TerrainGrid& g) { g.columns = 1; }),
            "a terrain of 1 x 2 points has no cells: give at least 2 x 2 points");
  EXPECT_EQ(with([](TerrainGrid& g) { g.columns = (1U << 20) + 1; }),
            "a terrain of 1048577 x 2 points is too large: divide it into several of at most 2^20 points a side and "
            "2^30 cells");
  EXPECT_EQ(with([](TerrainGrid& g) { g.heights.pop_back(); }),
            "a terrain of 3 x 2 points was given 5 heights: give one for each point");
  for (const double cell : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_NE(with([&](TerrainGrid& g) { g.cell = cell; }).find("give a positive, finite size"), std::string::npos);
  EXPECT_NE(with([](TerrainGrid& g) { g.cell = 1e-320; }).find("cannot be told apart"), std::string::npos);
  EXPECT_EQ(with([](TerrainGrid& g) { g.origin.y = HUGE_VAL; }),
            "a terrain's origin is not finite: give finite coordinates");
  EXPECT_EQ(with([&](TerrainGrid& g) { g.heights[4] = -kInfinity; }),
            "a terrain's height at column 1, row 1 is infinite: give a finite one, or NaN for none");
  EXPECT_EQ(with([&](TerrainGrid& g) { g.heights[1] = g.heights[4] = kNone; }),
            "a terrain has no triangle: three neighbouring points with heights are needed");
}

TEST(Terrain, RefusesToBeScaled) {
  const auto shape = flatTerrain(TerrainDiagonals::rising, {3, 3, 1});
  testing::internal::CaptureStderr();
  shape->setLocalScaling(btVector3(1, 1, 1));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  shape->setLocalScaling(btVector3(2, 2, 2));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "cairn: a terrain cannot be scaled by (2, 2, 2): scale the cell and the heights of its grid\n");
  EXPECT_EQ(shape->getLocalScaling(), btVector3(1, 1, 1));
  EXPECT_EQ(shape->upper(), btVector3(1, 1, 0));
}

TEST(Terrain, IsBoundedAndHasNoMass) {
  std::mt19937_64 engine(36);
  const auto shape = terrainOf(randomTerrain(engine, {20, 20, 1}));
  shape->setMargin(btScalar(0.25));
  btVector3 lower, upper, inertia(1, 1, 1);
  shape->getAabb(btTransform(btQuaternion::getIdentity(), btVector3(5, 6, 7)), lower, upper);
  for (const Found& f : allTriangles(*shape))
    for (const btVector3& c : f.corners)
      for (int axis = 0; axis < 3; ++axis) {
        const btScalar at = c[axis] + btVector3(5, 6, 7)[axis];
        EXPECT_GE(at, lower[axis] + btScalar(0.24));
        EXPECT_LE(at, upper[axis] - btScalar(0.24));
      }
  shape->calculateLocalInertia(1, inertia);
  EXPECT_EQ(inertia, btVector3(0, 0, 0));
  EXPECT_GE(shape->memoryBytes(), 400 * sizeof(float));
}

}  // namespace
}  // namespace cairn::test::terrain_test
