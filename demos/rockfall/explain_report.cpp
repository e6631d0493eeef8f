// SPDX-License-Identifier: GPL-3.0-or-later
#include "explain_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

namespace cairn::rockfall {

Explanation explain(const Scene& scene) {
  Explanation explanation{boundsOf(scene), {}, {}};
  explanation.outlooks = explainEffects(scene.description, explanation.bounds);
  explanation.warnings = sceneWarnings(scene.description, explanation.bounds);
  return explanation;
}

std::string explainText(const Scene& scene, const Explanation& explanation) {
  const auto& [bounds, outlooks, warnings] = explanation;
  const Case& description = scene.description;
  std::string text =
      fmt::format("case {}: step {:g} s, duration {:g} s, ground from {:.4g} to {:.4g} m\n", description.name,
                  description.stepS, description.durationS, scene.ground->lower().z, scene.ground->upper().z);
  const auto out = std::back_inserter(text);
  text += "group  rocks  sieve m        mass at most kg  fall at most m  speed at most m/s  inertia ratio at most\n";
  for (std::size_t g = 0; g < bounds.groups.size(); ++g) {
    const GroupBounds& group = bounds.groups[g];
    fmt::format_to(out, "{:>5}  {:>5}  {:<13}  {:>15.1f}  {:>14.1f}  {:>17.1f}  {:>21.2f}\n", g,
                   description.rocks[g].count,
                   fmt::format("{:.3g} to {:.3g}", group.smallestSieveM, group.largestSieveM), group.greatestMassKg,
                   group.greatestFallM, group.greatestSpeedMPerS, group.greatestInertiaRatio);
  }
  for (const MapNote& note : description.notes) fmt::format_to(out, "map {}: {}\n", note.path, note.text);
  fmt::format_to(out, "effects listed: {}; nothing else is simulated\n", outlooks.size());
  for (const EffectOutlook& outlook : outlooks) {
    const std::string whom =
        outlook.groups.empty() ? "never" : fmt::format("groups {}", fmt::join(outlook.groups, ", "));
    fmt::format_to(out, "  {:<22}  {:<16}  needs {}\n", outlook.name, whom, outlook.reason);
  }
  for (const SoilNote& soil : explainSoils(description)) fmt::format_to(out, "soil {}: {}\n", soil.path, soil.text);
  for (const EffectOutlook& outlook : outlooks)
    if (outlook.groups.empty())
      fmt::format_to(out, "warning: /effects/{}: \"{}\" can never act: it needs {}\n", outlook.index, outlook.name,
                     outlook.reason);
    else if (!outlook.advice.empty())
      fmt::format_to(out, "warning: /effects/{}: \"{}\": {}\n", outlook.index, outlook.name, outlook.advice);
  for (const SceneWarning& warning : warnings) fmt::format_to(out, "warning: {}: {}\n", warning.path, warning.text);
  return text;
}

std::string explainJson(const Scene& scene, const Explanation& explanation) {
  using Ordered = nlohmann::ordered_json;
  const auto& [bounds, outlooks, sceneWarnings] = explanation;
  Ordered groups = Ordered::array(), effects = Ordered::array(), warnings = Ordered::array();
  for (std::size_t g = 0; g < bounds.groups.size(); ++g) {
    const GroupBounds& group = bounds.groups[g];
    groups.push_back({{"rocks", scene.description.rocks[g].count},
                      {"sieve_m", {group.smallestSieveM, group.largestSieveM}},
                      {"max_mass_kg", group.greatestMassKg},
                      {"max_fall_m", group.greatestFallM},
                      {"max_speed_m_per_s", group.greatestSpeedMPerS},
                      {"max_struck_speed_m_per_s", group.struckSpeedMPerS},
                      {"max_inertia_ratio", group.greatestInertiaRatio}});
  }
  for (const EffectOutlook& outlook : outlooks)
    effects.push_back({{"effect", outlook.name},
                       {"path", fmt::format("/effects/{}", outlook.index)},
                       {"can_act", !outlook.groups.empty()},
                       {"groups", outlook.groups},
                       {"needs", outlook.reason},
                       {"advice", outlook.advice}});
  for (const SceneWarning& warning : sceneWarnings)
    warnings.push_back({{"path", warning.path}, {"warning", warning.text}});
  Ordered maps = Ordered::array();
  for (const MapNote& note : scene.description.notes) maps.push_back({{"path", note.path}, {"found", note.text}});
  Ordered soils = Ordered::array();
  for (const SoilNote& soil : explainSoils(scene.description))
    soils.push_back({{"path", soil.path}, {"soil", soil.text}});
  const Ordered json{{"case", scene.description.name},
                     {"ground_m", {scene.ground->lower().z, scene.ground->upper().z}},
                     {"maps", maps},
                     {"groups", groups},
                     {"effects", effects},
                     {"soils", soils},
                     {"warnings", warnings}};
  return json.dump(1) + "\n";
}

}  // namespace cairn::rockfall
