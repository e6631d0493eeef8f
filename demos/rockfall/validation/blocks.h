// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "rockfall/rocks/rock_stock.h"
#include "rockfall/validation/quarry_data.h"
#include "rockfall/validation/settings.h"

namespace cairn::rockfall {

/// A block that is let go: a scan at a size.
struct Block {
  std::size_t scan = 0;
  double sieveM = 0;  ///< middle one of its three extents
  double massKg = 0;
};

/// The blocks of the settings. `BlockChoice::scans`: the four scans as they are. `BlockChoice::measured`: for each
/// block measured on P1 the scan nearest to its proportions, at its mass; both slopes get these. Fails if no block was
/// measured.
Result<std::vector<Block>> chooseBlocks(const QuarryData& data, const RockStock& stock,
                                        const ValidationSettings& settings);

}  // namespace cairn::rockfall
