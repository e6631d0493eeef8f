// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "rockfall/simulation/release.h"
#include "rockfall/validation/quarry_data.h"
#include "rockfall/validation/settings.h"

namespace cairn::rockfall {

/// The experiment as a scene: its ground, and the four scans as four groups of rocks, of the size they were scanned in.
struct QuarryScene {
  QuarryData data;
  Scene scene;
  std::vector<std::string> repairs;  ///< what was closed of the scans
};

/// Reads the data, closes the scans, builds or loads the scans' certified trees. Fails as the data, the ground and
/// trees do.
Result<QuarryScene> prepareQuarry(const std::filesystem::path& folder, const ValidationSettings& settings,
                                  TreeCache& cache, const builder::ProgressCallback& progress = {});

/// Which block falls in a run: one alone, every scan from every place in every orientation, as in the published runs.
struct BlockRun {
  std::size_t profile = 0, scan = 0, drop = 0, orientation = 0;
};

/// All runs of a profile, scan by scan, place by place.
std::vector<BlockRun> runsOf(const QuarryScene& quarry, std::size_t profile);

/// How the block of a run begins: at rest, its centre of mass at the place.
ReleasedRock releaseOf(const QuarryScene& quarry, const BlockRun& run);

}  // namespace cairn::rockfall
