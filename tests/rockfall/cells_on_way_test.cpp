// SPDX-License-Identifier: GPL-3.0-or-later
// The cells that a way passes, against points close together on it.
#include "rockfall/simulation/cells_on_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace cairn::rockfall::cells_on_way_test {
namespace {

using Cell = std::pair<std::int32_t, std::int32_t>;

std::vector<Cell> enteredCells(const MapPoint& from, const MapPoint& to, double cell) {
  std::vector<Cell> cells;
  forEachCellEntered(from, to, cell, [&](std::int32_t column, std::int32_t row) { cells.emplace_back(column, row); });
  return cells;
}

Cell cellAt(const MapPoint& point, double cell) {
  return {cellOf(point[0], cell), cellOf(point[1], cell)};
}

TEST(CellsOnWay, AreThoseOfItsPointsOneBesideTheOther) {
  constexpr std::uint64_t kSeed = 7;
  std::mt19937_64 engine(kSeed);
  std::uniform_real_distribution<double> place(-5, 5), size(0.1, 3);
  for (int trial = 0; trial < 2000; ++trial) {
    const MapPoint from{place(engine), place(engine)}, to{place(engine), place(engine)};
    const double cell = size(engine);
    const std::vector<Cell> entered = enteredCells(from, to, cell);
    Cell last = cellAt(from, cell);
    for (const Cell& next : entered) {
      EXPECT_EQ(std::abs(next.first - last.first) + std::abs(next.second - last.second), 1)
          << "seed " << kSeed << ", trial " << trial;
      last = next;
    }
    EXPECT_EQ(last, cellAt(to, cell)) << "seed " << kSeed << ", trial " << trial;
    constexpr int kPoints = 1000;
    for (int i = 1; i <= kPoints; ++i) {
      const double part = static_cast<double>(i) / kPoints;
      const Cell here = cellAt({from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])}, cell);
      EXPECT_TRUE(here == cellAt(from, cell) || std::ranges::find(entered, here) != entered.end())
          << "seed " << kSeed << ", trial " << trial;
    }
  }
}

TEST(CellsOnWay, AreNoneWithinACellAndCertainOnBorders) {
  EXPECT_TRUE(enteredCells({0.1, 0.1}, {0.9, 0.9}, 1).empty());
  EXPECT_TRUE(enteredCells({0.5, 0.5}, {0.5, 0.5}, 1).empty());
  EXPECT_EQ(enteredCells({0.5, 0.5}, {3, 0.5}, 1), (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(enteredCells({0, 0}, {-0.5, 0}, 1), (std::vector<Cell>{{-1, 0}}));
  const std::vector<Cell> diagonal = enteredCells({0, 0}, {2, 2}, 1);
  ASSERT_EQ(diagonal.size(), 4U);
  EXPECT_EQ(diagonal.back(), Cell(2, 2));
}

}  // namespace
}  // namespace cairn::rockfall::cells_on_way_test
