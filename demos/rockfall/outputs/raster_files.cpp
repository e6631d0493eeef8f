// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/raster_files.h"

#include <array>
#include <functional>

#include "cairn/core/atomic_file.h"
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {
namespace {

struct RasterKind {
  const char *name, *description, *unit;
  double (*value)(const CellSummary&, const MergedRuns&);
};
constexpr std::array kRasters{
    RasterKind{"reach", "rocks that passed, of all runs", "",
               [](const CellSummary& c, const MergedRuns&) { return static_cast<double>(c.passages()); }},
    RasterKind{"reach_probability", "share of all released rocks that came here", "",
               [](const CellSummary& c, const MergedRuns& all) {
                 return static_cast<double>(c.arrived) / static_cast<double>(all.released);
               }},
    RasterKind{"stops", "rocks that ended here, of all runs", "",
               [](const CellSummary& c, const MergedRuns&) { return static_cast<double>(c.stops); }},
    RasterKind{"energy_max_j", "greatest kinetic energy", "J",
               [](const CellSummary& c, const MergedRuns&) { return c.energyJ.greatest(); }},
    RasterKind{"energy_p95_j", "95 % quantile of the rocks' greatest kinetic energies", "J",
               [](const CellSummary& c, const MergedRuns&) { return c.energyJ.quantile(950); }},
    RasterKind{"height_max_m", "greatest height of centres above the ground", "m",
               [](const CellSummary& c, const MergedRuns&) { return c.heightM.greatest(); }},
    RasterKind{"height_p95_m", "95 % quantile of the rocks' greatest heights", "m",
               [](const CellSummary& c, const MergedRuns&) { return c.heightM.quantile(950); }}};

std::function<double(const CellSummary&)> valueOf(const RasterKind& kind, const MergedRuns& merged) {
  return [&kind, &merged](const CellSummary& cell) { return kind.value(cell, merged); };
}

}  // namespace

std::vector<std::pair<std::string, std::string>> asciiRasters(const Case& description, const Ground& ground,
                                                              const MergedRuns& merged) {
  std::vector<std::pair<std::string, std::string>> files;
  if (!description.outputs.rasterCellM) return files;
  const RasterFrame frame = rasterFrame(ground, *description.outputs.rasterCellM);
  for (const RasterKind& kind : kRasters)
    files.emplace_back(std::string(kind.name) + ".asc", asciiGrid(rasterOf(frame, merged, valueOf(kind, merged))));
  return files;
}

Status writeGeoRasters(const std::filesystem::path& folder, const Case& description, const Ground& ground,
                       const MergedRuns& merged) {
  const OutputsSection& outputs = description.outputs;
  if (!outputs.rasterCellM) return {};
  const RasterFrame frame = rasterFrame(ground, *outputs.rasterCellM);
  const std::string prj = prjOf(ground.projection());
  for (const RasterKind& kind : kRasters) {
    if (!prj.empty())
      if (const Status written = writeFileAtomically(folder / (std::string(kind.name) + ".prj"), std::string_view(prj));
          !written)
        return written;
    if (!outputs.geotiff) continue;
    Raster raster = rasterOf(frame, merged, valueOf(kind, merged));
    raster.projection = ground.projection();
    const std::filesystem::path file = folder / (std::string(kind.name) + ".tif");
    if (const Status written = writeGeoTiff(file, raster, {kind.description, kind.unit}); !written) return written;
  }
  return {};
}

}  // namespace cairn::rockfall
