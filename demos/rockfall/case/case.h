// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/result.h"
#include "rockfall/case/collectors_section.h"
#include "rockfall/case/effect_options.h"
#include "rockfall/case/materials.h"
#include "rockfall/case/outputs_section.h"
#include "rockfall/case/rocks_section.h"
#include "rockfall/case/terrain_section.h"

namespace cairn::rockfall {

/// The budget of one step of the narrow phase. Microseconds make runs depend on the machine; operations do not.
struct BudgetSection {
  std::optional<std::uint64_t> operations;
  std::optional<double> microseconds;
};

/// What was found in a map that a case names.
struct MapNote {
  std::string path;  ///< in the case
  std::string text;  ///< how much it holds, what was left out, from where it was reprojected
};

/// A scene as its file describes it; no object is built yet. SI units. The world is z up; x and y are those of the map.
///
///     Result<Case> scene = readCase("slope.json");
struct Case {
  std::string name;
  std::uint64_t seed = 0;
  double stepS = 0, durationS = 0, gravityMPerS2 = 9.81;
  BudgetSection budget;
  Materials materials;
  TerrainSection terrain;
  std::vector<RockGroup> rocks;
  std::vector<EffectOptions> effects;
  std::vector<Collector> collectors;
  OutputsSection outputs;
  std::vector<MapNote> notes;  ///< on the maps that were read, in the order in which the case names them

  std::filesystem::path folder;  ///< of the case file; the file names in the case are relative to it
  /// SHA-256, hexadecimal, of the case without its comments and of the files it names. Cases with equal hashes give
  /// equal runs.
  std::string hash;

  std::filesystem::path pathOf(const std::string& file) const { return folder / file; }
  std::uint32_t stepCount() const;
};

/// The maps that a case names and that are not read yet.
std::vector<const MapSource*> mapsOf(const Case& scene);

/// Reads a case from a text; `file` is its name for messages. Fails in one sentence with file and JSON path. It refuses
/// invalid JSON, unknown or repeated keys, and materials that are not listed. It refuses values that are missing, of
/// the wrong kind or out of range, and files that cannot be read.
Result<Case> parseCase(std::string_view text, const std::string& file, const std::filesystem::path& folder);
Result<Case> readCase(const std::filesystem::path& path);

/// The JSON Schema (draft 2020-12) of case files: docs/rockfall-case.schema.json.
std::string_view caseSchema();

}  // namespace cairn::rockfall
