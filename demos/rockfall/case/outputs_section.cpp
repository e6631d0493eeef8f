// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/outputs_section.h"

namespace cairn::rockfall {

OutputsSection readOutputs(const Value& value) {
  Object object(value);
  OutputsSection outputs;
  if (const auto every = object.find("trajectories_every_s"))
    outputs.trajectoriesEveryS = every->number({0, 3600, true});
  if (const auto cell = object.find("raster_cell_m")) outputs.rasterCellM = cell->number({0.01, 1000});
  if (const auto geotiff = object.find("geotiff")) {
    outputs.geotiff = geotiff->flag();
    object.at("raster_cell_m");
  }
  if (const auto energy = object.find("impacts_above_j")) outputs.impactsAboveJ = energy->number(atLeast(0));
  return outputs;
}

}  // namespace cairn::rockfall
