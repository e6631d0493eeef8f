// SPDX-License-Identifier: GPL-3.0-or-later
// What holds of the effects a case lists, whichever they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
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

}  // namespace
}  // namespace cairn::rockfall::effects_test
