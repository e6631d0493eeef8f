// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rockfall/ensemble/parts.h"
#include "rockfall/outputs/enough_runs.h"

namespace cairn::rockfall {

struct MergeOptions {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path folder;
  bool png = false;         ///< also write figures as PNG
  bool geopackage = false;  ///< also write results.gpkg: trajectories, stops, collectors
  bool geojson = false;     ///< also write the same tables as GeoJSON, a file each
};

struct MergeReport {
  std::uint64_t runs = 0, rocks = 0, lost = 0;
  std::vector<RunRange> missing;         ///< runs, see `Parts::missing`
  double cpuS = 0;                       ///< of all runs
  std::vector<EffectReport> effects;     ///< summed over all runs
  std::vector<EffectRecord> did;         ///< the work of the same effects
  std::vector<QuantileCheck> quantiles;  ///< whether the runs are enough
  CellsCheck cells;                      ///< the same of the rasters' cells
  std::string hash;                      ///< SHA-256 over all files but what GDAL and rsvg-convert write, hexadecimal
};

/// Writes tables, rasters, trajectories and figures of all runs in the parts, each file completely or not at all, the
/// manifest last. The files depend only on the runs and on which are missing, not on their distribution or the folders'
/// order. Fails as `Parts::open` does, when a file cannot be written, for PNG without rsvg-convert, and for GeoPackage
/// and GeoJSON without GDAL.
Result<MergeReport> mergeOutputs(const MergeOptions& options);

}  // namespace cairn::rockfall
