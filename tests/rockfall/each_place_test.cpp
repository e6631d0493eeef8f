// SPDX-License-Identifier: GPL-3.0-or-later
// Rocks of each place of a map, which do not meet each other, and how rocks begin: orientation and velocity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "maps_fixture.h"
#include "prepared_scene.h"
#include "rockfall/simulation/release.h"
#include "rockfall/simulation/run.h"
#include "rockfall/simulation/scene_bounds.h"
#include "scenes/bodies/model.h"

namespace cairn::rockfall::each_place_test {
namespace {

using maps_test::kX;
using maps_test::kY;
using nlohmann::json;

/// Reads raster masks, which need no GDAL.
class EachPlace : public maps_test::Maps {
 protected:
  EachPlace() {
    std::ofstream(path("mask.asc")) << "ncols 4\nnrows 3\nxllcorner " << std::fixed << kX + 20 << "\nyllcorner "
                                    << kY + 60 << "\ncellsize 4\nNODATA_value -9\n1 1 0 1\n0 0 -9 0\n1 0 0 0\n";
    if (!hasGdal()) case_["terrain"].erase("crs");
    release({{"raster", "mask.asc"}});
    case_["rocks"][0].erase("count");
    case_["rocks"][0]["count_per_place"] = 3;
  }
  void SetUp() override {}

  Scene scene() const {
    TreeCache cache(test::treeFolder());
    auto parsed = parseCase(case_.dump(), "case.json", temporary_.path());
    EXPECT_TRUE(parsed) << parsed.error().message;
    auto made = prepareScene(std::move(parsed).value(), cache);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(made).value();
  }
};

TEST_F(EachPlace, HasItsRocks) {
  const Scene made = scene();
  EXPECT_EQ(made.description.rocks[0].count, 12U);
  const auto rocks = releaseRocks(made, 0);
  ASSERT_EQ(rocks.size(), 12U);
  std::map<std::pair<int, int>, int> cells;
  for (const ReleasedRock& rock : rocks) {
    const Vec3d place = scenes::fromBullet(rock.pose.getOrigin()) + Vec3d(made.worldOrigin[0], made.worldOrigin[1], 0);
    ++cells[{static_cast<int>(std::floor((place.x - kX - 20) / 4)),
             static_cast<int>(std::floor((place.y - kY - 60) / 4))}];
  }
  EXPECT_EQ(cells, (std::map<std::pair<int, int>, int>{{{0, 0}, 3}, {{0, 2}, 3}, {{1, 2}, 3}, {{3, 2}, 3}}));
  const auto again = releaseRocks(made, 0), other = releaseRocks(made, 1);
  EXPECT_TRUE(rocks[5].pose == again[5].pose);
  EXPECT_FALSE(rocks[5].pose == other[5].pose) << "another run draws other places in the same cells";
}

TEST_F(EachPlace, FallsAsIfAlone) {
  case_["outputs"] = {{"trajectories_every_s", 0.5}};
  case_["effects"] = json::parse(R"([{"effect": "friction", "default": 0.5}])");
  case_["duration_s"] = 6;
  case_["rocks"][0]["count_per_place"] = 20;
  const Scene made = scene();
  auto all = releaseRocks(made, 0);
  const RunResult together = simulate(made, 0, all).value().result;
  for (const std::size_t rock : {std::size_t(0), std::size_t(33), all.size() - 1}) {
    const RunResult alone = simulate(made, 0, {all[rock]}).value().result;
    const auto &crowd = together.trajectories[rock], &single = alone.trajectories[0];
    ASSERT_EQ(crowd.size(), single.size());
    for (std::size_t i = 0; i < crowd.size(); ++i) EXPECT_EQ(crowd[i].place, single[i].place) << rock << ", " << i;
  }
  // Where they may meet, eighty rocks on four cells do.
  case_["rocks"][0]["meets_rocks"] = true;
  const Scene meeting = scene();
  const RunResult jostling = simulate(meeting, 0, all).value().result;
  std::size_t others = 0;
  for (std::size_t rock = 0; rock < all.size(); ++rock)
    others += !(jostling.rocks[rock].end == together.rocks[rock].end);
  EXPECT_GT(others, all.size() / 2);
}

TEST_F(EachPlace, MeetsNoOtherGroup) {
  case_["rocks"].push_back(case_["rocks"][0]);
  case_["rocks"][1]["meets_rocks"] = true;
  const Scene made = scene();
  ASSERT_FALSE(made.description.rocks[0].meetsRocks);
  auto all = releaseRocks(made, 0);
  ASSERT_EQ(all.size(), 24U);
  // A rock that meets none and one that would, in the same place: neither is driven away.
  all[12].pose = all[0].pose;
  const RunResult both = simulate(made, 0, {all[0], all[12]}).value().result;
  EXPECT_EQ(both.rocks[0].end, simulate(made, 0, {all[0]}).value().result.rocks[0].end);
  EXPECT_EQ(both.rocks[1].end, simulate(made, 0, {all[12]}).value().result.rocks[0].end);
}

// Contacts of pieces between two rocks are looked for, not bits: the order in which pieces are solved is not theirs
// alone.
TEST_F(EachPlace, BreaksIntoPiecesThatMeetNone) {
  case_["effects"] = json::parse(R"([{"effect": "friction", "default": 0.5},
                                     {"effect": "fragmentation", "energy_j_per_kg": 20, "max_generations": 1}])");
  case_["outputs"] = {{"impacts_above_j", 1}};
  case_["rocks"][0]["release"]["above_ground_m"] = 5;
  case_["duration_s"] = 2;
  const auto betweenRocks = [](const RunResult& result) {
    return std::ranges::count_if(result.impacts, [](const ImpactRecord& impact) { return impact.other >= 0; });
  };
  const RunResult apart = simulate(scene(), 0).value().result;
  EXPECT_GT(apart.rocks.size(), 14U) << "some broke";
  EXPECT_EQ(betweenRocks(apart), 0);
  case_["rocks"][0]["meets_rocks"] = true;
  EXPECT_GT(betweenRocks(simulate(scene(), 0).value().result), 0);
}

TEST_F(EachPlace, IsRefusedWhereThereIsNone) {
  EXPECT_TRUE(read()) << refusal();
  case_["rocks"][0]["count_per_place"] = 30000;
  EXPECT_EQ(refusal(),
            "/rocks/0/release/raster: mask.asc has 4 places, so there would be 120000 rocks, more than 100000: take "
            "fewer of each, or a coarser map");
  case_["rocks"][0]["count"] = 3;
  EXPECT_EQ(refusal(), "case.json: /rocks/0: exactly one of \"count\" and \"count_per_place\" must be given");
  case_["rocks"][0].erase("count");
  case_["rocks"][0]["count_per_place"] = 1;
  case_["rocks"][0]["release"] = {{"box_m", {{kX + 12, kY + 60}, {kX + 22, kY + 70}}}, {"above_ground_m", 1}};
  EXPECT_EQ(
      refusal(),
      "case.json: /rocks/0/release: \"count_per_place\" needs the places of a map: give \"vector\" or \"raster\"");
  if (!hasGdal()) return;
  test::writeMap(path("cliff.geojson"), {{maps_test::kCliff}});
  release({{"vector", "cliff.geojson"}});
  EXPECT_TRUE(refusal().starts_with("/rocks/0/release/vector: cliff.geojson holds lines or polygons, and"))
      << refusal();
  test::writeMap(path("points.geojson"), {{test::pointAt(kX + 15, kY + 70)}, {test::pointAt(kX + 16, kY + 71)}});
  release({{"vector", "points.geojson"}});
  case_["rocks"][0]["count_per_place"] = 4;
  EXPECT_EQ(good().rocks[0].count, 8U);
}

TEST(Release_AGivenOrientation, TurnsARockThatLiesFlat) {
  json document = test::plainCase();
  document["rocks"][0]["make"] = {{"kind", "slabby"}};
  const auto basisOf = [&](const json& degrees) {
    document["rocks"][0]["release"]["orientation_deg"] = degrees;
    const Scene scene = test::prepared(document);
    const auto rocks = releaseRocks(scene, 0);
    EXPECT_EQ(rocks[0].pose.getBasis(), rocks[1].pose.getBasis()) << "all rocks alike";
    return rocks[0].pose.getBasis();
  };
  const auto isNear = [](const btVector3& a, const btVector3& b) { return (a - b).length() < 1e-6; };
  const btVector3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(basisOf({0, 0, 0}), btMatrix3x3::getIdentity());
  const btMatrix3x3 onEdge = basisOf({90, 0, 0});
  EXPECT_TRUE(isNear(onEdge.getColumn(0), x)) << "the long axis stays";
  EXPECT_TRUE(isNear(onEdge.getColumn(2), -y)) << "the thin axis lies";
  const btMatrix3x3 across = basisOf({90, 0, 90});
  EXPECT_TRUE(isNear(across.getColumn(0), y)) << "first about x, then about the map's z";
  EXPECT_TRUE(isNear(across.getColumn(2), x));
}

TEST(Release_ASpreadOfVelocity, FillsItsBoxAndIsBounded) {
  json document = test::plainCase();
  document["rocks"][0]["count"] = 400;
  document["rocks"][0]["meets_rocks"] = false;
  const Scene still = test::prepared(document);
  document["rocks"][0]["release"]["velocity_m_per_s"] = {3, 0, -1};
  document["rocks"][0]["release"]["velocity_spread_m_per_s"] = {2, 0.5, 0};
  const Scene scene = test::prepared(document);
  double sum = 0, least = 9, most = -9;
  const auto rocks = releaseRocks(scene, 0), others = releaseRocks(still, 0);
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const btVector3& v = rocks[i].velocity;
    EXPECT_TRUE(v.x() >= 1 && v.x() <= 5 && std::abs(v.y()) <= 0.5 && v.z() == -1);
    EXPECT_TRUE(rocks[i].pose == others[i].pose) << "the draws of places and orientations stay";
    sum += static_cast<double>(v.x());
    least = std::min(least, static_cast<double>(v.x()));
    most = std::max(most, static_cast<double>(v.x()));
  }
  // Four deviations of the mean of 400 draws from a width of 4; the ends are missed by a tenth with a chance of e^-20.
  EXPECT_NEAR(sum / 400, 3, 4 * 4 / std::sqrt(12.0 * 400));
  EXPECT_LT(least, 1.2);
  EXPECT_GT(most, 4.8);
  EXPECT_GE(boundsOf(scene).groups[0].greatestSpeedMPerS, std::sqrt(5 * 5 + 0.5 * 0.5 + 1));
}

}  // namespace
}  // namespace cairn::rockfall::each_place_test
