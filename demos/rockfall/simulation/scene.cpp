// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/scene.h"

#include <fmt/format.h>

#include <utility>

#include "rockfall/case/content_hash.h"

namespace cairn::rockfall {
namespace {

Status checkReleases(const Case& description, const Ground& ground) {
  for (std::size_t group = 0; group < description.rocks.size(); ++group) {
    const auto& [a, b] = description.rocks[group].release.boxM;
    for (const MapPoint& corner : {a, b, MapPoint{a[0], b[1]}, MapPoint{b[0], a[1]}})
      if (!ground.covers(corner))
        return Error{fmt::format(
            "/rocks/{}/release/box_m: the corner ({:g}, {:g}) is not over the ground, which covers "
            "x from {:g} to {:g} and y from {:g} to {:g}",
            group, corner[0], corner[1], ground.lower().x, ground.upper().x, ground.lower().y, ground.upper().y)};
  }
  return {};
}

/// Before anything is run, because the merge would fail for it.
Status checkRaster(const Case& description, const Ground& ground) {
  constexpr double kMostCells = 64e6;
  if (!description.outputs.rasterCellM) return {};
  const double cell = *description.outputs.rasterCellM;
  const double cells = (ground.upper().x - ground.lower().x) / cell * ((ground.upper().y - ground.lower().y) / cell);
  if (cells <= kMostCells) return {};
  return Error{
      fmt::format("/outputs/raster_cell_m: rasters would have {:.3g} million cells, more than {:.0f} million: "
                  "use larger ones",
                  cells / 1e6, kMostCells / 1e6)};
}

}  // namespace

Result<Scene> prepareScene(Case description, TreeCache& cache, const builder::ProgressCallback& progress) {
  auto ground = makeGround(description);
  if (!ground) return ground.error();
  if (const Status checked = checkReleases(description, *ground.value()); !checked) return checked.error();
  if (const Status checked = checkRaster(description, *ground.value()); !checked) return checked.error();
  auto stock = stockRocks(description, cache, progress);
  if (!stock) return stock.error();
  ContentHash hash;
  hash.add(description.hash);
  hash.add(stock.value().hash);
  return Scene{std::move(description), std::move(ground).value(), std::move(stock).value(), hash.hex()};
}

}  // namespace cairn::rockfall
