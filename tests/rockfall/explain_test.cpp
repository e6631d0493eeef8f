// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "prepared_scene.h"
#include "rockfall/case/scene_warnings.h"
#include "rockfall/simulation/run.h"
#include "rockfall/simulation/scene_bounds.h"

namespace cairn::rockfall::explain_test {
namespace {

using nlohmann::json;

/// An effect on the plain case, and whether it could act there: a slope of 40 m at 30 degrees, 23 m high.
struct Outlook {
  const char* effect;
  bool canAct;

  friend std::ostream& operator<<(std::ostream& out, const Outlook& outlook) { return out << outlook.effect; }
};

class Outlooks : public ::testing::TestWithParam<Outlook> {};

TEST_P(Outlooks, FollowFromTheBounds) {
  json document = test::plainCase();
  document["rocks"][0]["tree_depth"] = 1;
  document["rocks"][0]["meets_rocks"] = false;
  document["effects"].clear();
  document["effects"].push_back(json::parse(GetParam().effect));
  const Scene scene = test::prepared(document);
  const auto outlooks = explainEffects(scene.description, boundsOf(scene));
  ASSERT_EQ(outlooks.size(), 1U);
  EXPECT_EQ(!outlooks[0].groups.empty(), GetParam().canAct) << outlooks[0].reason;
}
INSTANTIATE_TEST_SUITE_P(
    Each, Outlooks,
    ::testing::Values(
        Outlook{R"({"effect": "friction", "default": 0.5})", true},
        Outlook{R"({"effect": "friction", "default": 0})", false},
        // soil on soil never meets: no rock is of soil
        Outlook{R"({"effect": "friction", "default": 0, "pairs": [{"materials": ["soil", "soil"], "value": 1}]})",
                false},
        Outlook{R"({"effect": "friction", "default": 0, "pairs": [{"materials": ["soil", "stone"], "value": 1}]})",
                true},
        Outlook{R"({"effect": "rolling_resistance", "default_m": 0})", false},
        Outlook{R"({"effect": "rolling_resistance", "default_m": 0, "spinning_default_m": 0.1})", true},
        Outlook{R"({"effect": "tangential_restitution", "default": 1})", false},
        Outlook{R"({"effect": "tangential_restitution", "default": 0.9})", true},
        Outlook{R"({"effect": "restitution", "law": "constant", "default": 0})", false},
        Outlook{R"({"effect": "restitution", "law": "bourrier", "default_half_speed_m_per_s": 2})", true},
        Outlook{R"({"effect": "slip_friction", "min": 0, "max": 1, "kappa_per_m": 1, "recovery_per_s": 1,
                    "pairs": [["soil", "soil"]]})",
                false},
        Outlook{R"({"effect": "surface_roughness", "materials": [{"material": "soil", "roughness_m": 0.1}]})", true},
        Outlook{R"({"effect": "surface_roughness", "materials": [{"material": "soil", "roughness_m": 0}]})", false},
        Outlook{R"({"effect": "gyroscopic"})", true},
        Outlook{R"({"effect": "gyroscopic", "min_inertia_ratio": 50})", false},
        // 22 m/s for 0.01 s is 0.22 m; the smallest radius is 0.2 m
        Outlook{R"({"effect": "ccd", "radii_per_step": 0.5})", true},
        Outlook{R"({"effect": "ccd", "radii_per_step": 2})", false},
        Outlook{R"({"effect": "sleeping", "linear_m_per_s": 0, "angular_rad_per_s": 1, "after_s": 1})", false},
        Outlook{R"({"effect": "air_drag"})", true}, Outlook{R"({"effect": "air_drag", "coefficient": 0})", false},
        Outlook{R"({"effect": "water", "level_m": -0.1})", false},
        Outlook{R"({"effect": "water", "level_m": 0.1})", true},
        // the pond is high up the slope, above its level
        Outlook{R"({"effect": "water", "level_m": 5, "polygon_m": [[0, -5], [10, -5], [10, 5]]})", false},
        Outlook{R"({"effect": "water", "level_m": 5, "polygon_m": [[100, -5], [110, -5], [110, 5]]})", false},
        Outlook{R"({"effect": "forest_drag", "height_m": 5, "coefficient_kg_per_s": 10})", true},
        Outlook{R"({"effect": "forest_drag", "height_m": 5, "coefficient_kg_per_s": 10,
                    "polygon_m": [[100, -5], [110, -5], [110, 5]]})",
                false},
        Outlook{R"({"effect": "trees", "energy_ratio": 1, "stems": [[20, 0, 0.3]]})", true},
        Outlook{R"({"effect": "trees", "energy_ratio": 0, "stems": [[20, 0, 0.3]]})", false},
        Outlook{R"({"effect": "trees", "energy_ratio": 1, "stems": [[200, 0, 0.3]]})", false},
        Outlook{R"({"effect": "trees", "energy_ratio": 1, "stems": {"density_per_ha": 0, "diameter_m": [0.1, 0.2]}})",
                false},
        Outlook{R"({"effect": "soil_scarring", "materials":
                    [{"material": "soil", "strength_kpa": 100, "density_kg_per_m3": 1500, "drag_coefficient": 1}]})",
                true},
        Outlook{R"({"effect": "ground_drag", "deceleration_m_per_s2": 0})", false},
        // 9.81 times 25 to 30 m
        Outlook{R"({"effect": "fragmentation", "energy_j_per_kg": 200, "max_generations": 1})", true},
        Outlook{R"({"effect": "fragmentation", "energy_j_per_kg": 400, "max_generations": 1})", false},
        Outlook{R"({"effect": "events", "dust_impulse_n_s": 1e9})", false},
        Outlook{R"({"effect": "events", "dust_impulse_n_s": 1e9, "sound_impulse_n_s": 100})", true}));

/// A light rock that lies in the way of a heavy one of 20 m/s.
json struckCase() {
  json document = test::plainCase();
  document["duration_s"] = 2;
  document["terrain"]["slope_deg"] = 0;
  document["effects"] = json::parse(R"([
    {"effect": "friction", "default": 0.5}, {"effect": "restitution", "law": "constant", "default": 0.5},
    {"effect": "ccd", "radii_per_step": 1}, {"effect": "fragmentation", "energy_j_per_kg": 100, "max_generations": 1}])");
  json& heavy = document["rocks"][0];
  heavy["tree_depth"] = 1;
  heavy["count"] = 1;
  heavy["sieve_m"]["sizes"] = {{2, 0}, {2, 1}};
  heavy["release"] = json::parse(R"({"box_m": [[5, 0], [5, 0]], "above_ground_m": 0, "velocity_m_per_s": [20, 0, 0]})");
  document["rocks"].push_back(heavy);
  json& light = document["rocks"][1];
  light["sieve_m"]["sizes"] = {{0.3, 0}, {0.3, 1}};
  light["release"] = json::parse(R"({"box_m": [[10, 0], [10, 0]], "above_ground_m": 0})");
  return document;
}

TEST(ExplainedEffects, OfARockThatAnotherStrikesMayAct) {
  const json document = struckCase();
  const Scene scene = test::prepared(document);
  const SceneBounds bounds = boundsOf(scene);
  const RunResult result = simulate(scene, 0).value().result;
  EXPECT_GT(result.rocks[1].maxSpeed, bounds.groups[1].greatestSpeedMPerS) << "it is struck";
  EXPECT_LT(result.rocks[1].maxSpeed, bounds.groups[1].struckSpeedMPerS);
  const auto outlooks = explainEffects(scene.description, bounds);
  EXPECT_EQ(outlooks[2].groups, std::vector<std::uint32_t>{1}) << "ccd: the heavy one is too large";
  EXPECT_EQ(outlooks[3].groups, (std::vector<std::uint32_t>{0, 1})) << "fragmentation";
}

TEST(ExplainedEffects, SaySoWhereOnlyARockThatIsStruckIsFastEnough) {
  json document = struckCase();
  document["effects"][3]["energy_j_per_kg"] = 1000;
  const auto outlook = [&] {
    const Scene scene = test::prepared(document);
    return explainEffects(scene.description, boundsOf(scene))[3];
  };
  EXPECT_EQ(outlook().groups, std::vector<std::uint32_t>{1});
  EXPECT_NE(outlook().advice.find("only a rock that others strike"), std::string::npos) << outlook().advice;
  for (json& group : document["rocks"]) group["meets_rocks"] = false;
  EXPECT_TRUE(outlook().groups.empty());
}

TEST(ExplainedRollingResistance, AsksForWhatStopsTheSpinOfRocksThatItHoldsUp) {
  json document = test::plainCase();
  document["rocks"][0]["tree_depth"] = 1;
  const auto adviceOn = [&](const char* effect) {
    document["effects"] = json::array({json::parse(effect)});
    const Scene scene = test::prepared(document);
    return explainEffects(scene.description, boundsOf(scene))[0].advice;
  };
  EXPECT_NE(adviceOn(R"({"effect": "rolling_resistance", "default_m": 0.1})").find("spinning_default_m"),
            std::string::npos);
  EXPECT_EQ(adviceOn(R"({"effect": "rolling_resistance", "default_m": 0.1, "spinning_default_m": 0.02})"), "");
  EXPECT_EQ(adviceOn(R"({"effect": "rolling_resistance", "default_m": 0})"), "");
}

/// The warnings for the plain case, with changes: 22 m/s at most, smallest radius 0.2 m, cells of 1 m.
std::string warningsAbout(const std::function<void(json&)>& change) {
  json document = test::plainCase();
  document["rocks"][0]["tree_depth"] = 1;
  document["effects"] = json::array({{{"effect", "friction"}, {"default", 0.5}},
                                     {{"effect", "restitution"}, {"law", "constant"}, {"default", 0.3}},
                                     {{"effect", "ccd"}}});
  document["step_s"] = 0.004;
  change(document);
  const Scene scene = test::prepared(document);
  std::string all;
  for (const SceneWarning& warning : sceneWarnings(scene.description, boundsOf(scene)))
    all += warning.path + ": " + warning.text + "\n";
  return all;
}

TEST(SceneWarnings, AreNoneForASceneThatHasWhatItNeeds) {
  EXPECT_EQ(warningsAbout([](json&) {}), "");
}

TEST(SceneWarnings, AreOfStepsInWhichASmallRockPassesItsRadius) {
  EXPECT_EQ(warningsAbout([](json& d) { d["step_s"] = 0.008; }), "");
  const std::string told = warningsAbout([](json& d) { d["step_s"] = 0.012; });
  EXPECT_NE(told.find("/step_s: a rock of group 0 may pass 0.2"), std::string::npos) << told;
  EXPECT_NE(told.find("radius of 0.2 m: try 0.00"), std::string::npos) << told;
  EXPECT_EQ(std::ranges::count(told, '\n'), 1) << told;
}

TEST(SceneWarnings, AreOfStepsInWhichACellOfTheGroundIsPassed) {
  const std::string told = warningsAbout([](json& d) {
    d["step_s"] = 0.008;
    d["terrain"]["cell_m"] = 0.1;
  });
  EXPECT_NE(told.find("a cell of the ground of 0.1 m"), std::string::npos) << told;
}

TEST(SceneWarnings, AreOfWhatASceneNeedsAndDoesNotList) {
  const auto without = [](std::size_t effect) {
    return warningsAbout([effect](json& d) { d["effects"].erase(effect); });
  };
  EXPECT_NE(without(0).find("no \"friction\" is listed"), std::string::npos);
  EXPECT_NE(without(1).find("no \"restitution\" is listed"), std::string::npos);
  EXPECT_EQ(without(2), "") << "9 cm in a step: less than half a radius";
  const std::string fast = warningsAbout([](json& d) {
    d["effects"].erase(2);
    d["step_s"] = 0.006;
  });
  EXPECT_NE(fast.find("no \"ccd\" is listed"), std::string::npos) << fast;
}

TEST(SceneBounds_OfSpeedAndFall, HoldForRunsOfTheScene) {
  json document = test::plainCase();
  document["effects"] = json::array();  // nothing brakes
  document["rocks"][0]["release"]["velocity_m_per_s"] = {3, 1, 0};
  const Scene scene = test::prepared(document);
  const GroupBounds bounds = boundsOf(scene).groups[0];
  for (std::uint64_t run = 0; run < 10; ++run) {
    const RunResult result = simulate(scene, run).value().result;
    for (const RockRecord& rock : result.rocks) {
      EXPECT_LT(rock.maxSpeed, bounds.greatestSpeedMPerS);
      EXPECT_LT(rock.start.z - scene.ground->lower().z, bounds.greatestFallM);
      EXPECT_LE(rock.massKg, bounds.greatestMassKg);
    }
  }
}

TEST(SceneBounds_GroundMaterials, AreThoseSomewhereOnTheGround) {
  json document = test::plainCase();
  document["materials"].push_back("far");
  document["terrain"]["zones"].push_back(
      json::parse(R"({"material": "far", "polygon_m": [[41, 5], [41, 20], [38, 20]]})"));
  const Scene scene = test::prepared(document);
  EXPECT_EQ(boundsOf(scene).groundMaterials, (std::vector<MaterialId>{0, 1}));
}

}  // namespace
}  // namespace cairn::rockfall::explain_test
