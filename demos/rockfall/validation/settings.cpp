// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/settings.h"

#include <cassert>

#include "cairn/core/atomic_file.h"
#include "rockfall/case/cursor.h"
#include "rockfall/case/effects_section.h"
#include "rockfall/validation/quarry_data.h"

namespace cairn::rockfall {

std::string_view builtInSettingsText();

namespace {

constexpr std::size_t kMaxParameters = 50, kMaxPlaces = 20;

CalibratedParameter readParameter(const Value& value, const Json& document) {
  Object object(value);
  CalibratedParameter parameter;
  parameter.name = object.at("name").text();
  for (const Value& place : object.at("at").items(1, kMaxPlaces)) {
    const std::string pointer = place.text();
    parameter.places.push_back(pointer);
    if (!pointer.starts_with("/effects/") && pointer != "/drop_speed_m_per_s")
      place.refuse("only numbers of the effects and the drop's speed can be calibrated");
    // Json's pointers throw for what they cannot read.
    try {
      if (!document.at(Json::json_pointer(pointer)).is_number()) place.refuse("there is no number at this place");
    } catch (const Json::exception&) {
      place.refuse("there is nothing at this place of the settings");
    }
  }
  const Value range = object.at("range");
  if (const auto ends = range.items(2, 2); ends.size() == 2) {
    parameter.range = {ends[0].number(), ends[1].number()};
    if (!(parameter.range[0] < parameter.range[1])) range.refuse("the second number must be greater than the first");
  }
  return parameter;
}

CalibrationPlan readPlan(const Value& value, const Json& document) {
  Object object(value);
  CalibrationPlan plan;
  plan.seed = object.at("seed").whole(0, std::uint64_t{1} << 53);
  plan.candidates = static_cast<std::uint32_t>(object.at("candidates").whole(1, 100000));
  plan.rounds = static_cast<std::uint32_t>(object.at("rounds").whole(1, 100));
  plan.blocks = static_cast<std::uint32_t>(object.at("blocks").whole(1, 1000000));
  for (const Value& item : object.at("parameters").items(1, kMaxParameters))
    plan.parameters.push_back(readParameter(item, document));
  return plan;
}

ValidationSettings readSections(const Value& value, const Json& document) {
  Object object(value);
  ValidationSettings settings;
  settings.document = document;
  if (object.at("validation").text() != "authume") object.refuse("\"validation\" must be \"authume\"");
  if (const auto origin = object.find("origin")) origin->text();
  settings.seed = object.at("seed").whole(0, std::uint64_t{1} << 53);
  settings.stepS = object.at("step_s").number({1e-5, 0.1});
  settings.durationS = object.at("duration_s").number({0, 3600, true});
  settings.cellM = object.at("cell_m").number({0.05, 10});
  constexpr std::array<std::string_view, 2> kBlockChoices{"scans", "measured"};
  settings.blocks = static_cast<BlockChoice>(object.at("blocks").choice(kBlockChoices, "choice of blocks"));
  settings.dropSpeedMPerS = object.at("drop_speed_m_per_s").number({0, 20});
  settings.densityKgPerM3 = object.at("density_kg_per_m3").number({500, 10000});
  settings.treeDepth = static_cast<std::uint32_t>(object.at("tree_depth").whole(1, 5));
  settings.materials.emplace_back(kBlockMaterial);
  for (const GroundZone& zone : kGroundZones) settings.materials.emplace_back(zone.material);
  settings.effects = readEffects(object.at("effects"), settings.materials);
  settings.calibration = readPlan(object.at("calibration"), document);
  return settings;
}

}  // namespace

Result<ValidationSettings> settingsOf(const Json& document, const std::string& file) {
  Complaint complaint(file);
  ValidationSettings settings = readSections(Value(&document, "", complaint), document);
  if (complaint.first()) return Error{*complaint.first()};
  return settings;
}

Result<ValidationSettings> readSettings(const std::filesystem::path& file) {
  const auto content = readFile(file);
  if (!content) return content.error();
  const std::string_view text(reinterpret_cast<const char*>(content.value().data()), content.value().size());
  const auto document = parseDocument(text, file.string());
  if (!document) return document.error();
  return settingsOf(document.value(), file.string());
}

Result<ValidationSettings> builtInSettings() {
  const auto document = parseDocument(builtInSettingsText(), "authume.json");
  if (!document) return document.error();
  return settingsOf(document.value(), "authume.json");
}

std::vector<double> valuesOf(const ValidationSettings& settings) {
  std::vector<double> values;
  for (const CalibratedParameter& parameter : settings.calibration.parameters)
    values.push_back(settings.document.at(Json::json_pointer(parameter.places.front())).get<double>());
  return values;
}

Result<ValidationSettings> withValues(const ValidationSettings& settings, const std::vector<double>& values) {
  assert(values.size() == settings.calibration.parameters.size());
  Json document = settings.document;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string& place : settings.calibration.parameters[i].places)
      document.at(Json::json_pointer(place)) = values[i];
  return settingsOf(document, "settings");
}

}  // namespace cairn::rockfall
