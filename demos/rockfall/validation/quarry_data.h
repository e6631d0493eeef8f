// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::rockfall {

/// A block that was let go in the experiment, where it stopped.
struct MeasuredBlock {
  Vec3d stop;
  double massKg = 0;
  std::array<double, 3> boxM{};  ///< greatest first
};

/// A simulated block of those who published the experiment, where it was when they stopped.
struct PublishedRun {
  std::string shape;
  Vec3d stop;
  double maxSpeedMPerS = 0;
};

/// One of the quarry's two slopes. What the folder does not hold is empty.
struct QuarryProfile {
  std::string name;
  std::vector<Vec3d> drops;
  std::vector<std::size_t> dropLines;  ///< of the file, for each of them
  std::vector<MeasuredBlock> blocks;
  std::vector<PublishedRun> published;
};

/// The quarry of Authume as Garcia et al. (2022) published it. The map's frame: x down the slope, z up, and y against
/// the data's z; the data have y up. Metres, kilograms.
struct QuarryData {
  std::filesystem::path folder;
  std::vector<QuarryProfile> profiles;
  std::vector<std::array<double, 4>> orientations;  ///< unit quaternions in the data's frame, the real part first
};

inline constexpr std::array<const char*, 2> kProfileNames{"P1", "P2"};
/// The scanned blocks, each a file NAME.stl.
inline constexpr std::array<const char*, 4> kScanNames{"SP1A", "SP2A", "SP2B", "SP3A"};
/// The kinds of ground, each a file of its own: materials of the settings.
struct GroundZone {
  const char* material;
  const char* file;
};
inline constexpr std::array<GroundZone, 3> kGroundZones{
    GroundZone{"blue", "DTM_Blue_zone.stl"}, {"gray", "DTM_Gray_zone.stl"}, {"red", "DTM_Red_zone.stl"}};

/// From the data's frame to the map's: a quarter turn about x.
inline Vec3d fromData(const Vec3d& p) {
  return {p.x, -p.z, p.y};
}

/// The file of the places from which the blocks of a profile fall.
std::filesystem::path dropsFile(const std::filesystem::path& folder, const std::string& profile);

/// Reads positions, orientations, where blocks stopped and the published runs. Where blocks stopped may be missing, of
/// either profile, and so may the published runs. Fails with file and line.
Result<QuarryData> readQuarry(const std::filesystem::path& folder);

}  // namespace cairn::rockfall
