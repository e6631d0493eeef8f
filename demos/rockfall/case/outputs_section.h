// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "rockfall/case/cursor.h"

namespace cairn::rockfall {

/// What is to be written beside the tables of runs, rocks and collectors; what is not asked for is not computed.
struct OutputsSection {
  std::optional<double> trajectoriesEveryS;  ///< rounded to whole steps, at least one
  std::optional<double> rasterCellM;
  bool geotiff = false;                 ///< rasters as GeoTIFF too
  std::optional<double> impactsAboveJ;  ///< impacts of at least that kinetic energy
};

OutputsSection readOutputs(const Value& value);

}  // namespace cairn::rockfall
