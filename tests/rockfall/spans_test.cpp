// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that each run draws for itself, and published classes of soil.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "cairn/effects/friction.h"
#include "prepared_scene.h"
#include "rockfall/case/explain.h"
#include "rockfall/case/soil_classes.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::spans_test {
namespace {

using nlohmann::json;

/// A slab that slides down an even slope of 30 degrees: v^2 = 2 g s (sin - f cos), if it does not tumble.
json slidingCase(const json& friction) {
  json document = test::plainCase();
  document["terrain"].erase("zones");
  document["rocks"][0]["count"] = 1;
  document["rocks"][0]["make"] = {{"kind", "slabby"}};
  document["rocks"][0]["release"]["above_ground_m"] = 0;
  document["rocks"][0]["release"]["orientation_deg"] = {0, 30, 0};
  document["effects"] = json::array({{{"effect", "friction"}, {"default", friction}}});
  document["duration_s"] = 1;
  return document;
}

double endOf(const Scene& scene, std::uint64_t run) {
  return simulate(scene, run).value().result.rocks[0].end.x;
}

TEST(ASpan, IsDrawnByEachRunAndBetweenItsEnds) {
  const Scene scene = test::prepared(slidingCase({0.1, 0.4}));
  const Scene slippery = test::prepared(slidingCase(0.1)), rough = test::prepared(slidingCase(0.4));
  std::set<double> ends;
  for (std::uint64_t run = 0; run < 12; ++run) {
    const double end = endOf(scene, run);
    EXPECT_EQ(end, endOf(scene, run)) << "a pure function of case and number";
    EXPECT_LT(end, endOf(slippery, run));
    EXPECT_GT(end, endOf(rough, run));
    // Where the rocks begin is drawn too: only what friction did is compared.
    ends.insert(std::round(1e4 * (endOf(slippery, run) - end)));
  }
  EXPECT_GT(ends.size(), 10U);
}

TEST(ASpan, OfEqualEndsIsTheNumber) {
  const Scene span = test::prepared(slidingCase({0.3, 0.3})), number = test::prepared(slidingCase(0.3));
  // The hash of the case differs, the run does not.
  EXPECT_EQ(simulate(span, 4).value().result.stateHash, simulate(number, 4).value().result.stateHash);
}

TEST(ASpan, IsDrawnForEachPairByItself) {
  json document = slidingCase({0.1, 0.4});
  const Scene before = test::prepared(document);
  document["effects"][0]["pairs"] = json::array({{{"materials", {"stone", "stone"}}, {"value", {0.1, 0.9}}}});
  const Scene after = test::prepared(document);
  EXPECT_EQ(simulate(before, 2).value().result.stateHash, simulate(after, 2).value().result.stateHash)
      << "another pair's draw shifts none";
  document["effects"][0]["pairs"][0]["materials"] = {"stone", "soil"};
  EXPECT_NE(simulate(before, 2).value().result.stateHash,
            simulate(test::prepared(document), 2).value().result.stateHash);
}

TEST(ASpan, IsReadOrRefused) {
  const auto refusal = [](const json& friction) {
    const auto read = test::readJson(slidingCase(friction));
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(refusal({0.2, 0.2}), "");
  EXPECT_EQ(refusal({0.4, 0.2}), "case.json: /effects/0/default: the smaller value comes first");
  EXPECT_TRUE(refusal({0.4}).starts_with("case.json: /effects/0/default: ")) << refusal({0.4});
  EXPECT_TRUE(refusal({0.4, 11}).starts_with("case.json: /effects/0/default/1: ")) << refusal({0.4, 11});
}

json soilCase(const char* law, const char* soil) {
  json document = test::plainCase();
  document["effects"].push_back({{"effect", "restitution"},
                                 {"law", law},
                                 {"default", 0.2},
                                 {"pairs", json::array({{{"materials", {"stone", "soil"}}, {"soil", soil}}})}});
  return document;
}

TEST(Soils, AreThePublishedOnes) {
  // Means of the table, in the order of the types: the middle of each range but for the last digit.
  const std::vector<double> means{0, 0.23, 0.28, 0.33, 0.38, 0.43, 0.53, 0.35};
  ASSERT_EQ(soilClasses().size(), means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const SoilClass& soil = soilClasses()[i];
    EXPECT_EQ(soil.name, "rockyfor3d-" + std::to_string(i));
    EXPECT_NEAR((soil.restitution.low + soil.restitution.high) / 2, means[i], 0.0051) << soil.name;
    // The model varies the mean by a tenth to either side.
    EXPECT_NEAR(soil.restitution.high - soil.restitution.low, 0.2 * means[i], 0.0101) << soil.name;
  }
}

TEST(Soils, StandForTheirRangesAndAreExplained) {
  const auto read = test::readJson(soilCase("pfeiffer", "rockyfor3d-4"));
  ASSERT_TRUE(read) << read.error().message;
  const auto* options = findEffect<RestitutionOptions>(read.value().effects);
  EXPECT_EQ(options->value.at(0, 1), (Span{0.34, 0.42}));
  const auto notes = explainSoils(read.value());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].path, "/effects/1/pairs/0");
  EXPECT_EQ(notes[0].text,
            "rockyfor3d-4 is talus slope above about 10 cm, or compact soil with large rock fragments: 0.34 to 0.42, "
            "drawn by each run (Dorren 2016, Rockyfor3D (v5.2) revealed, 2.1)");
  const auto refusal = [](const json& document) { return test::readJson(document).error().message; };
  EXPECT_NE(refusal(soilCase("pfeiffer", "rockyfor3d-8")).find("there is no class of soil \"rockyfor3d-8\""),
            std::string::npos);
  EXPECT_NE(refusal(soilCase("constant", "rockyfor3d-4")).find("/effects/1/pairs/0/soil"), std::string::npos)
      << "its law is Pfeiffer's";
  json both = soilCase("pfeiffer", "rockyfor3d-4");
  both["effects"][1]["pairs"][0]["value"] = 0.3;
  EXPECT_EQ(refusal(both), "case.json: /effects/1/pairs/0: exactly one of \"value\" and \"soil\" must be given");
}

}  // namespace
}  // namespace cairn::rockfall::spans_test
