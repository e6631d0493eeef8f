// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "rockfall/ensemble/compute_each.h"
#include "rockfall/simulation/run_result.h"
#include "rockfall/validation/quarry_scene.h"

namespace cairn::rockfall {

/// Where a block came to.
struct BlockEnd {
  Vec3d stop;  ///< on the map; where it was last over the ground
  RockEnd ending = RockEnd::moving;
  double maxSpeedMPerS = 0, maxEnergyJ = 0, endS = 0;
};

/// Simulates runs in `jobs` processes: the same ends for any number of them. Fails as `simulate` and `computeEach` do.
Result<std::vector<BlockEnd>> simulateBlocks(const QuarryScene& quarry, std::span<const BlockRun> runs,
                                             std::uint32_t jobs, const ShareDone& progress = {});

}  // namespace cairn::rockfall
