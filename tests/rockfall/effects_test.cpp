// SPDX-License-Identifier: GPL-3.0-or-later
// Rules for the effects that a case lists, whichever they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "prepared_scene.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::effects_test {
namespace {

using nlohmann::json;

std::string hashOf(const json& document) {
  const Scene scene = test::prepared(document);
  return simulate(scene, 0).value().result.stateHash;
}

json exampleOf(const std::string& name) {
  json document = json::parse(std::ifstream(test::exampleFile(name)), nullptr, true, true);
  document["duration_s"] = 8;
  for (json& group : document["rocks"]) group["tree_depth"] = 1;
  return document;
}

/// Two of one kind keep their order: stands of trees are told apart by it.
TEST(ACasesEffects, GiveTheSameWhateverTheirOrder) {
  for (const char* name : {"forest.json", "valley.json", "lake.json", "quarry.json"}) {
    json document = exampleOf(name);
    const std::string hash = hashOf(document);
    std::vector<json> effects = document["effects"];
    std::ranges::stable_sort(effects, std::greater<>{},
                             [](const json& effect) { return effect["effect"].get<std::string>(); });
    document["effects"] = effects;
    EXPECT_EQ(hashOf(document), hash) << name << " by falling names";
    std::ranges::stable_sort(effects, std::less<>{},
                             [](const json& effect) { return effect["effect"].get<std::string>(); });
    document["effects"] = effects;
    EXPECT_EQ(hashOf(document), hash) << name << " by rising names";
  }
}

/// The case as it is shipped: rocks come down to the belt, some pass it and meet the stems below.
TEST(TheForest, BrakesSomeAndLetsSomePass) {
  const Scene scene = test::prepared(json::parse(std::ifstream(test::exampleFile("forest.json")), nullptr, true, true));
  std::array<std::set<std::pair<std::uint64_t, std::uint32_t>>, 3> passed;  // by collector
  std::uint64_t stems = 0, rocks = 0;
  for (std::uint64_t run = 0; run < 10; ++run) {
    const RunResult result = simulate(scene, run).value().result;
    rocks += result.rocks.size();
    for (const CrossingRecord& crossing : result.crossings) passed[crossing.collector].insert({run, crossing.rock});
    for (const EffectRecord& effect : result.effects)
      if (effect.name == "trees") stems += effect.acts;
  }
  const auto [above, below, hut] = passed;
  EXPECT_GT(above.size(), rocks / 2);
  EXPECT_LT(below.size(), above.size());
  EXPECT_GT(below.size(), rocks / 2);
  EXPECT_GT(stems, below.size()) << "more than one each";
  EXPECT_GT(hut.size(), 0U);
  EXPECT_LT(hut.size(), below.size());
}

/// Each effect of no strength, by each of its keys that takes it; those that have none, with a criterion that nothing
/// meets.
const std::map<std::string, std::vector<json>>& ofNoStrength() {
  static const auto effects = [] {
    std::map<std::string, std::vector<json>> byName;
    for (const char* text :
         {R"({"effect": "friction", "default": 0})",
          R"({"effect": "rolling_resistance", "default_m": 0, "spinning_default_m": 0})",
          R"({"effect": "restitution", "law": "bourrier", "default_half_speed_m_per_s": 0})",
          R"({"effect": "tangential_restitution", "default": 1})",
          R"({"effect": "slip_friction", "min": 0, "max": 0, "kappa_per_m": 1, "recovery_per_s": 1})",
          R"({"effect": "surface_roughness", "materials": [{"material": "soil", "roughness_m": 0}]})",
          R"({"effect": "gyroscopic", "min_inertia_ratio": 1000})",
          R"({"effect": "ccd", "radii_per_step": 100})",
          R"({"effect": "sleeping", "linear_m_per_s": 0, "angular_rad_per_s": 100, "after_s": 0})",
          R"({"effect": "sleeping", "linear_m_per_s": 100, "angular_rad_per_s": 0, "after_s": 0})",
          R"({"effect": "air_drag", "coefficient": 0})",
          R"({"effect": "air_drag", "density_kg_per_m3": 0})",
          R"({"effect": "water", "level_m": 50, "density_kg_per_m3": 0})",
          R"({"effect": "forest_drag", "height_m": 5, "coefficient_kg_per_s": 0})",
          R"({"effect": "forest_drag", "height_m": 0, "coefficient_kg_per_s": 1e9})",
          R"({"effect": "trees", "energy_ratio": 0, "stems": {"density_per_ha": 2000, "diameter_m": [0.2, 0.4]}})",
          R"({"effect": "trees", "stems": {"density_per_ha": 0, "diameter_m": [0.2, 0.4]}})",
          R"({"effect": "soil_scarring", "materials": [{"material": "soil", "strength_kpa": 100,
              "density_kg_per_m3": 1500, "drag_coefficient": 0}]})",
          R"({"effect": "soil_scarring", "materials": [{"material": "soil", "strength_kpa": 100,
              "density_kg_per_m3": 0, "drag_coefficient": 1}]})",
          R"({"effect": "ground_drag", "deceleration_m_per_s2": 0})",
          R"({"effect": "ground_drag", "within_m": 0, "deceleration_m_per_s2": 100})",
          R"({"effect": "ground_drag", "below_m_per_s": 0, "deceleration_m_per_s2": 100})",
          R"({"effect": "fragmentation", "energy_j_per_kg": 1e9, "max_generations": 1})",
          R"({"effect": "barrier", "line_m": [[4, -5], [4, 5]], "height_m": 3, "capacity_j": 0})",
          R"({"effect": "barrier", "line_m": [[4, -5], [4, 5]], "height_m": 0, "capacity_j": 1e9})",
          R"({"effect": "events", "dust_impulse_n_s": 1e12})"}) {
      json effect = json::parse(text);
      const auto name = effect["effect"].get<std::string>();
      byName[name].push_back(std::move(effect));
    }
    return byName;
  }();
  return effects;
}

std::vector<std::string> namesOfEffects() {
  std::vector<std::string> names;
  for (const auto& [name, settings] : ofNoStrength()) names.push_back(name);
  return names;
}

class EachEffect : public ::testing::TestWithParam<std::string> {};

TEST(EveryEffect, IsTriedWithoutStrength) {
  EXPECT_EQ(ofNoStrength().size(), std::variant_size_v<EffectOptions>) << "add a new effect to the list";
}

// Among others that do act, on angular rocks that slide, bounce, roll and meet each other.
TEST_P(EachEffect, OfNoStrengthIsAbsent) {
  json document = test::plainCase();
  document["rocks"][0]["count"] = 4;
  document["rocks"][0]["tree_depth"] = 1;
  json& effects = document["effects"];
  effects.push_back(json::parse(R"({"effect": "restitution", "law": "constant", "default": 0.4})"));
  effects.push_back(json::parse(R"({"effect": "rolling_resistance", "default_m": 0.05})"));
  effects.push_back(json::parse(R"({"effect": "air_drag"})"));
  for (std::size_t i = effects.size(); i-- > 0;)
    if (effects[i]["effect"] == GetParam()) effects.erase(i);
  const std::string without = hashOf(document);
  for (const json& effect : ofNoStrength().at(GetParam())) {
    effects.push_back(effect);
    EXPECT_EQ(hashOf(document), without) << effect;
    effects.erase(effects.size() - 1);
  }
}
INSTANTIATE_TEST_SUITE_P(Rockfall, EachEffect, ::testing::ValuesIn(namesOfEffects()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace cairn::rockfall::effects_test
