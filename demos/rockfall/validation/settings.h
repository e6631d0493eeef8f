// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rockfall/case/document.h"
#include "rockfall/case/effect_options.h"

namespace cairn::rockfall {

/// A number of the settings that calibration may choose, the same at all its places.
struct CalibratedParameter {
  std::string name;
  std::vector<std::string> places;  ///< JSON pointers into the settings
  std::array<double, 2> range{};
};

/// How calibration searches, see `calibrate`.
struct CalibrationPlan {
  std::uint64_t seed = 1;
  std::uint32_t candidates = 0;  ///< in each round
  std::uint32_t rounds = 0;
  std::uint32_t blocks = 0;  ///< that each candidate lets go
  std::vector<CalibratedParameter> parameters;
};

/// Which blocks fall, see `chooseBlocks`.
enum class BlockChoice : std::uint8_t { scans, measured };

/// What the experiment does not say and a simulation needs. A file of its own: JSON with comments, SI units.
struct ValidationSettings {
  Json document;  ///< as it was read
  std::uint64_t seed = 0;
  double stepS = 0, durationS = 0;
  double cellM = 0;  ///< of the ground's grid
  BlockChoice blocks = BlockChoice::measured;
  double dropSpeedMPerS = 0;  ///< with which blocks leave the shovel, down the slope
  double densityKgPerM3 = 0;
  std::uint32_t treeDepth = 3;
  Materials materials;  ///< the block's, then the ground's
  std::vector<EffectOptions> effects;
  CalibrationPlan calibration;
};

inline constexpr const char* kBlockMaterial = "block";

Result<ValidationSettings> settingsOf(const Json& document, const std::string& file);
Result<ValidationSettings> readSettings(const std::filesystem::path& file);
/// Those the program brings with it: demos/rockfall/validation/authume.json.
Result<ValidationSettings> builtInSettings();

/// The parameters' values, in their order.
std::vector<double> valuesOf(const ValidationSettings& settings);
/// The settings with others. Fails as `settingsOf` does.
Result<ValidationSettings> withValues(const ValidationSettings& settings, const std::vector<double>& values);

}  // namespace cairn::rockfall
