// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/manifest.h"

#include <fmt/format.h>

#include "cairn/core/atomic_file.h"

namespace cairn::rockfall {

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
    return Error{fmt::format("{} holds no finished runs (it has no {}): run the same command again to finish them",
                             folder.string(), kManifestName)};
  const auto content = readFile(file);
  if (!content) return content.error();
  try {
    const Json json = Json::parse(content.value().begin(), content.value().end());
    Manifest manifest{json.at("case"),
                      json.at("case_folder").get<std::string>(),
                      json.at("case_hash").get<std::string>(),
                      json.at("scene_hash").get<std::string>(),
                      json.at("versions"),
                      {}};
    for (const Json& range : json.at("runs"))
      manifest.asked = hullOf(manifest.asked, {range.at(0).get<std::uint64_t>(), range.at(1).get<std::uint64_t>()});
    return manifest;
  } catch (const Json::exception&) {
    return Error{fmt::format("{} is no manifest of runs", file.string())};
  }
}

}  // namespace cairn::rockfall
