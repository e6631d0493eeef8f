// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cairn/core/atomic_file.h"

namespace cairn::rockfall {
namespace {

bool areRanges(const Json& json) {
  const auto isNumber = [](const Json& run) {
    return run.is_number_unsigned() && run.get<std::uint64_t>() <= kMaxRuns;
  };
  return json.is_array() && !json.empty() && std::ranges::all_of(json, [&](const Json& range) {
           return range.is_array() && range.size() == 2 && isNumber(range[0]) && isNumber(range[1]) &&
                  range[0] < range[1];
         });
}

}  // namespace

Status writeManifest(const std::filesystem::path& folder, const Manifest& manifest) {
  const nlohmann::ordered_json json{
      {"case_hash", manifest.caseHash},     {"scene_hash", manifest.sceneHash},
      {"versions", manifest.versions},      {"runs", Json::array({{manifest.asked.first, manifest.asked.last}})},
      {"case_folder", manifest.caseFolder}, {"case", manifest.document}};
  return writeFileAtomically(folder / kManifestName, json.dump(1) + "\n");
}

Result<Manifest> readManifest(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kManifestName;
  if (!std::filesystem::exists(file))
    return Error{fmt::format("{} is no folder of runs (it has no {}): give one that \"rockfall run\" has made",
                             folder.string(), kManifestName)};
  const auto content = readFile(file);
  if (!content) return content.error();
  const Error none{fmt::format("{} is no manifest of runs", file.string())};
  try {
    const Json json = Json::parse(content.value().begin(), content.value().end());
    Manifest manifest{json.at("case"),
                      json.at("case_folder").get<std::string>(),
                      json.at("case_hash").get<std::string>(),
                      json.at("scene_hash").get<std::string>(),
                      json.at("versions"),
                      {}};
    if (!areRanges(json.at("runs"))) return none;
    for (const Json& range : json.at("runs"))
      manifest.asked = hullOf(manifest.asked, {range[0].get<std::uint64_t>(), range[1].get<std::uint64_t>()});
    return manifest;
  } catch (const Json::exception&) {
    return none;
  }
}

}  // namespace cairn::rockfall
