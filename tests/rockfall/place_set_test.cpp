// SPDX-License-Identifier: GPL-3.0-or-later
// Places drawn from points, lines and areas: inside them, and even, judged by counting in a lattice of cells.
#include "rockfall/case/place_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "random_tree.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall::place_set_test {
namespace {

using test::uniform;

MapPoint draw(const PlaceSet& places, std::mt19937_64& engine) {
  const double which = uniform(engine, 0, 1), along = uniform(engine, 0, 1);
  return places.at(which, along, uniform(engine, 0, 1));
}

/// An L, turned, with a hole in its foot.
Area hooked() {
  Area area{{{0, 0}, {10, 1}, {9.5, 4}, {3.5, 3}, {3, 12}, {-1, 11}}, {{{5, 1}, {8, 1.5}, {7, 3}}}};
  return area;
}

TEST(PlaceSet, DrawsEvenlyFromAnAreaWithAHole) {
  constexpr std::uint64_t kSeed = 5;
  std::mt19937_64 engine(kSeed);
  PlaceSet places;
  ASSERT_TRUE(places.addArea(hooked()));
  constexpr int kDraws = 200000;
  constexpr double kCell = 1;
  std::map<std::pair<int, int>, int> counts;
  for (int i = 0; i < kDraws; ++i) {
    const MapPoint place = draw(places, engine);
    ASSERT_TRUE(areaContains(hooked(), place)) << place[0] << ", " << place[1];
    ++counts[{static_cast<int>(std::floor(place[0] / kCell)), static_cast<int>(std::floor(place[1] / kCell))}];
  }
  // The share of each cell that the area covers, by a fine lattice.
  constexpr int kFine = 100;
  std::map<std::pair<int, int>, int> covered;
  int all = 0;
  for (int i = -2 * kFine; i < 12 * kFine; ++i)
    for (int j = -2 * kFine; j < 14 * kFine; ++j)
      if (areaContains(hooked(), {(i + 0.5) / kFine, (j + 0.5) / kFine})) {
        ++covered[{static_cast<int>(std::floor((i + 0.5) / kFine)), static_cast<int>(std::floor((j + 0.5) / kFine))}];
        ++all;
      }
  for (const auto& [cell, part] : covered) {
    const double expected = static_cast<double>(kDraws) * part / all;
    // Five standard deviations, and what the fine lattice may miss along a border.
    EXPECT_NEAR(counts[cell], expected, 5 * std::sqrt(expected + 1) + 0.02 * kDraws / all * kFine)
        << cell.first << ", " << cell.second;
  }
}

TEST(PlaceSet, DrawsFromLinesByTheirLength) {
  std::mt19937_64 engine(6);
  PlaceSet places;
  places.addLine({{0, 0}, {3, 0}, {3, 0}, {3, 1}});
  places.addLine({{10, 10}, {10, 10}});
  int onFirst = 0;
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const MapPoint place = draw(places, engine);
    ASSERT_TRUE(place[1] == 0 || place[0] == 3);
    onFirst += place[1] == 0;
  }
  EXPECT_NEAR(onFirst, 0.75 * kDraws, 5 * std::sqrt(0.75 * 0.25 * kDraws));
}

TEST(PlaceSet, DrawsEachPointAlike) {
  std::mt19937_64 engine(7);
  PlaceSet places;
  const std::array<MapPoint, 3> points{MapPoint{1, 2}, MapPoint{2600000.25, 1200000.5}, MapPoint{-3, 0}};
  for (const MapPoint& point : points) places.addPoint(point);
  std::map<MapPoint, int> counts;
  for (int i = 0; i < 30000; ++i) ++counts[draw(places, engine)];
  ASSERT_EQ(counts.size(), 3U) << "the points, to the bit";
  for (const MapPoint& point : points) EXPECT_NEAR(counts[point], 10000, 5 * std::sqrt(10000 * 2.0 / 3));
}

TEST(PlaceSet, HoldsItsEdgesAndNothingOfNoSize) {
  PlaceSet places;
  ASSERT_TRUE(places.addArea({{{0, 0}, {1, 0}, {2, 0}}, {}}));
  EXPECT_TRUE(places.empty());
  ASSERT_TRUE(places.addArea({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {}}));
  EXPECT_EQ(places.at(0, 0, 0), (MapPoint{0, 0}));
  EXPECT_EQ(places.at(1, 1, 1), (MapPoint{4, 2}));
  places.moveBy({10, 20});
  EXPECT_EQ(places.at(0.5, 0.5, 0.5), (MapPoint{12, 21}));
}

TEST(PlaceSet, RefusesACombOfMillionsOfPieces) {
  // Each strip between two heights passes all teeth.
  Area comb;
  constexpr int kTeeth = 2000;
  for (int i = 0; i < kTeeth; ++i) {
    comb.outline.push_back({2.0 * i, 0.001 * i});
    comb.outline.push_back({2.0 * i + 1, 1000 + 0.001 * i});
  }
  comb.outline.push_back({2.0 * kTeeth, -1});
  comb.outline.push_back({0, -1});
  PlaceSet places;
  EXPECT_FALSE(places.addArea(comb));
}

}  // namespace
}  // namespace cairn::rockfall::place_set_test
