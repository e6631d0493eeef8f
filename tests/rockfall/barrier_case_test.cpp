// SPDX-License-Identifier: GPL-3.0-or-later
// A barrier in a case: what it takes and holds, and collectors with corners.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "prepared_scene.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::barrier_case_test {
namespace {

using nlohmann::json;

json caseWith(double capacityJ, double heightM = 10) {
  json document = test::plainCase();
  document["rocks"][0]["tree_depth"] = 1;
  document["duration_s"] = 8;
  document["effects"].push_back({{"effect", "barrier"},
                                 {"line_m", {{15, -10}, {15, 0}, {16, 10}}},
                                 {"height_m", heightM},
                                 {"capacity_j", capacityJ}});
  document["effects"].push_back(
      {{"effect", "sleeping"}, {"linear_m_per_s", 0.1}, {"angular_rad_per_s", 0.1}, {"after_s", 0.5}});
  return document;
}

RunResult run(const json& document) {
  auto finished = simulate(test::prepared(document), 0);
  EXPECT_TRUE(finished) << finished.error().message;
  return std::move(finished).value().result;
}

TEST(BarrierInACase, HoldsAllThatItCanTake) {
  const RunResult open = run(caseWith(0)), closed = run(caseWith(1e8));
  EXPECT_EQ(open.crossings.size(), 2U) << "both rocks reach the toe";
  EXPECT_TRUE(closed.crossings.empty());
  for (const RockRecord& rock : closed.rocks) {
    EXPECT_EQ(rock.ending, RockEnd::resting);
    EXPECT_LT(rock.end.x, 16);
  }
  EXPECT_EQ(closed.effects.at(1).acts, 2U);
  EXPECT_GT(closed.effects.at(1).energyTakenJ, 0);
}

TEST(BarrierInACase, LetsTheRestPass) {
  const RunResult open = run(caseWith(0)), weak = run(caseWith(500));
  ASSERT_EQ(weak.crossings.size(), 2U);
  EXPECT_EQ(weak.effects.at(1).acts, 2U);
  EXPECT_NEAR(weak.effects.at(1).energyTakenJ, 1000, 1) << "twice its capacity, to single precision";
  EXPECT_LT(weak.crossings[0].energyJ, open.crossings[0].energyJ);
}

TEST(BarrierInACase, OfNoStrengthIsAsIfItWereNot) {
  json without = caseWith(0);
  without["effects"].erase(1);
  EXPECT_EQ(run(caseWith(0)).stateHash, run(without).stateHash);
  EXPECT_EQ(run(caseWith(1e8, 0)).stateHash, run(without).stateHash) << "no height: all fly over it";
}

TEST(BarrierInACase, BesideTheGroundIsRefused) {
  json document = caseWith(1e6);
  document["effects"][1]["line_m"] = {{500, 0}, {500, 10}};
  auto description = test::readJson(document);
  ASSERT_TRUE(description);
  TreeCache cache(test::treeFolder());
  const auto scene = prepareScene(std::move(description).value(), cache);
  ASSERT_FALSE(scene);
  EXPECT_TRUE(scene.error().message.starts_with("/effects/1/line_m: no part of it is over the ground"))
      << scene.error().message;
}

TEST(CollectorsWithCorners, CountWhatTheirPartsWouldCount) {
  json document = caseWith(0);
  document["rocks"][0]["count"] = 6;
  document["collectors"] = {{{"name", "whole"}, {"line_m", {{18, -10}, {20, -1}, {19, 1}, {22, 10}}}},
                            {{"name", "a"}, {"line_m", {{18, -10}, {20, -1}}}},
                            {{"name", "b"}, {"line_m", {{20, -1}, {19, 1}}}},
                            {{"name", "c"}, {"line_m", {{19, 1}, {22, 10}}}}};
  const RunResult result = run(document);
  std::vector<CrossingRecord> whole, parts;
  for (const CrossingRecord& crossing : result.crossings) (crossing.collector == 0 ? whole : parts).push_back(crossing);
  ASSERT_GE(whole.size(), 6U);
  ASSERT_EQ(whole.size(), parts.size());
  const std::array<double, 3> before{0, std::hypot(2.0, 9.0), std::hypot(2.0, 9.0) + std::hypot(1.0, 2.0)};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i].rock, parts[i].rock);
    EXPECT_EQ(whole[i].timeS, parts[i].timeS);
    EXPECT_EQ(whole[i].energyJ, parts[i].energyJ);
    EXPECT_NEAR(whole[i].alongM, before[parts[i].collector - 1] + parts[i].alongM, 1e-12);
  }
}

}  // namespace
}  // namespace cairn::rockfall::barrier_case_test
