// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "rockfall/simulation/release.h"
#include "rockfall/validation/blocks.h"
#include "rockfall/validation/settings.h"

namespace cairn::rockfall {

/// The experiment as a scene: its ground, and the four scans as four groups of rocks, of the size they were scanned in.
struct QuarryScene {
  QuarryData data;
  Scene scene;
  std::vector<Block> blocks;
  double dropSpeedMPerS = 0;
  std::vector<std::string> repairs;  ///< what was closed of the scans
};

/// Reads the data, closes the scans, builds or loads the scans' certified trees. Fails as the data, the ground and
/// trees do.
Result<QuarryScene> prepareQuarry(const std::filesystem::path& folder, const ValidationSettings& settings,
                                  TreeCache& cache, const builder::ProgressCallback& progress = {});

/// Takes over what a search may change: the effects' numbers, and the speed of the drop.
void useSettings(QuarryScene& quarry, const ValidationSettings& settings);

/// Which block falls in a run, alone.
struct BlockRun {
  std::size_t profile = 0, block = 0, drop = 0, orientation = 0;
};

/// The runs of a profile, block by block, place by place: every orientation, or, of many blocks, every n-th, so that
/// there are about as many runs as the published 1024.
std::vector<BlockRun> runsOf(const QuarryScene& quarry, std::size_t profile);

/// How the block of a run begins: with its centre of mass at the place.
ReleasedRock releaseOf(const QuarryScene& quarry, const BlockRun& run);

}  // namespace cairn::rockfall
