// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_documents.h"

#include <algorithm>

namespace cairn::test {

std::vector<std::filesystem::path> exampleFiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(CAIRN_ROCKFALL_EXAMPLES))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::filesystem::path exampleFile(const std::string& name) {
  return std::filesystem::path(CAIRN_ROCKFALL_EXAMPLES) / name;
}

nlohmann::json plainCase() {
  return nlohmann::json::parse(R"({
    "case": "plain", "seed": 1, "step_s": 0.01, "duration_s": 4, "budget": {"operations": 20000},
    "materials": ["stone", "soil"],
    "terrain": {"generated": "plane", "length_m": 40, "width_m": 20, "slope_deg": 30, "material": "soil",
                "zones": [{"material": "stone", "polygon_m": [[30, -10], [40, -10], [40, 10]]}]},
    "rocks": [{"count": 2, "make": {"kind": "angular", "concave": true}, "sieve_m": {"sizes": [[0.4, 0], [0.8, 1]]},
               "tree_depth": 2, "density_kg_per_m3": 2600, "material": "stone",
               "release": {"box_m": [[3, -3], [6, 3]], "above_ground_m": 1}}],
    "effects": [{"effect": "friction", "default": 0.5,
                 "pairs": [{"materials": ["stone", "soil"], "value": 0.6}]}],
    "collectors": [{"name": "toe", "line_m": [[20, -10], [20, 10]]}],
    "outputs": {"trajectories_every_s": 0.1, "raster_cell_m": 1, "impacts_above_j": 100}})");
}

Result<rockfall::Case> readJson(const nlohmann::json& document) {
  return rockfall::parseCase(document.dump(), "case.json", CAIRN_ROCKFALL_EXAMPLES);
}

}  // namespace cairn::test
