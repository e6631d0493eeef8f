// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "rockfall/case/cursor.h"

namespace cairn::rockfall {

/// The outputs beside the tables of runs, rocks and collectors. Outputs without a request are not computed.
struct OutputsSection {
  std::optional<double> trajectoriesEveryS;  ///< rounded to whole steps, at least one
  std::optional<double> rasterCellM;
  bool geotiff = false;                 ///< also write rasters as GeoTIFF
  std::optional<double> impactsAboveJ;  ///< record impacts of at least this kinetic energy
};

OutputsSection readOutputs(const Value& value);

}  // namespace cairn::rockfall
