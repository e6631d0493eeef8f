// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "rockfall/case/content_hash.h"
#include "rockfall/simulation/effect_factory.h"
#include "rockfall/simulation/world_origin.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {
namespace {

Status checkReleases(const Case& description, const Ground& ground, const MapPoint& origin) {
  for (std::size_t group = 0; group < description.rocks.size(); ++group) {
    const auto& [a, b] = description.rocks[group].release.boxM;
    for (const MapPoint& corner : {a, b, MapPoint{a[0], b[1]}, MapPoint{b[0], a[1]}})
      if (!ground.covers(corner))
        return Error{
            fmt::format("/rocks/{}/release/box_m: the corner ({:.10g}, {:.10g}) is not over the ground, which covers "
                        "x from {:.10g} to {:.10g} and y from {:.10g} to {:.10g}{}",
                        group, origin[0] + corner[0], origin[1] + corner[1], origin[0] + ground.lower().x,
                        origin[0] + ground.upper().x, origin[1] + ground.lower().y, origin[1] + ground.upper().y,
                        ground.isWithin(corner) ? " but for holes" : "")};
  }
  return {};
}

// As `contains` and `covers` have it, looked at in as many points as make a cell's width between them, at most this
// many.
constexpr int kMaxPoints = 2000;

bool isSomewhereOver(const Ground& ground, const std::array<MapPoint, 2>& line) {
  const double length = std::hypot(line[1][0] - line[0][0], line[1][1] - line[0][1]);
  const int count = std::clamp(static_cast<int>(std::min(length / ground.cellM(), 1e6)) + 1, 1, kMaxPoints);
  for (int i = 0; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    if (ground.covers({line[0][0] + part * (line[1][0] - line[0][0]), line[0][1] + part * (line[1][1] - line[0][1])}))
      return true;
  }
  return false;
}

Error besideTheGround(const std::string& path, const Ground& ground, const MapPoint& origin) {
  return Error{
      fmt::format("{}: no part of it is over the ground, which covers x from {:.10g} to {:.10g} and y from "
                  "{:.10g} to {:.10g}: give it in the terrain's own coordinates, or leave it out",
                  path, origin[0] + ground.lower().x, origin[0] + ground.upper().x, origin[1] + ground.lower().y,
                  origin[1] + ground.upper().y)};
}

/// What lies beside the ground can never be met: a slip of the pen, or coordinates of another map.
Status checkPlaces(const Case& description, const Ground& ground, const MapPoint& origin) {
  for (std::size_t i = 0; i < description.collectors.size(); ++i)
    if (!isSomewhereOver(ground, description.collectors[i].line))
      return besideTheGround(fmt::format("/collectors/{}/line_m", i), ground, origin);
  for (std::size_t i = 0; i < description.terrain.zones.size(); ++i) {
    const Zone& zone = description.terrain.zones[i];
    if (zone.polygon.empty()) continue;
    const bool isBeside = zone.upper[0] < ground.lower().x || zone.lower[0] > ground.upper().x ||
                          zone.upper[1] < ground.lower().y || zone.lower[1] > ground.upper().y;
    if (isBeside) return besideTheGround(fmt::format("/terrain/zones/{}/polygon_m", i), ground, origin);
  }
  return {};
}

/// Before anything is run, because the merge would fail for it.
Status checkRaster(const Case& description, const Ground& ground) {
  constexpr double kMaxCells = 64e6;
  if (!description.outputs.rasterCellM) return {};
  if (description.outputs.geotiff && !hasGdal())
    return Error{
        "/outputs/geotiff: this program was built without GDAL, which GeoTIFF needs: install libgdal-dev and build "
        "again, or do without"};
  const double cell = *description.outputs.rasterCellM;
  const double cells = (ground.upper().x - ground.lower().x) / cell * ((ground.upper().y - ground.lower().y) / cell);
  if (cells <= kMaxCells) return {};
  return Error{
      fmt::format("/outputs/raster_cell_m: rasters would have {:.3g} million cells, more than {:.0f} million: "
                  "use larger ones",
                  cells / 1e6, kMaxCells / 1e6)};
}

/// Adds the terrain as it was read, beside the bytes of the case's files, because a raster may refer to further files.
void add(ContentHash& hash, const bullet::TerrainGrid& grid) {
  const std::array<double, 6> frame{double(grid.columns), double(grid.rows), grid.cell,
                                    grid.origin.x,        grid.origin.y,     grid.origin.z};
  hash.add(std::as_bytes(std::span(frame)));
  hash.add(std::as_bytes(std::span(grid.heights)));
}

}  // namespace

Result<Scene> prepareScene(Case description, TreeCache& cache, const builder::ProgressCallback& progress) {
  auto terrain = terrainOf(description);
  if (!terrain) return terrain.error();
  return prepareScene(std::move(description), std::move(terrain).value(), cache, progress);
}

Result<Scene> prepareScene(Case description, MapTerrain terrain, TreeCache& cache,
                           const builder::ProgressCallback& progress) {
  bullet::TerrainGrid& grid = terrain.grid;
  const auto worldOrigin = worldOriginOf(grid);
  if (!worldOrigin) return worldOrigin.error();
  const MapPoint& origin = worldOrigin.value();
  ContentHash hash;
  hash.add(description.hash);
  add(hash, grid);
  moveToWorld(description, origin);
  grid.origin = grid.origin - Vec3d(origin[0], origin[1], 0);
  auto ground = makeGround(std::move(terrain), description.terrain);
  if (!ground) return ground.error();
  if (const Status checked = checkReleases(description, *ground.value(), origin); !checked) return checked.error();
  if (const Status checked = checkPlaces(description, *ground.value(), origin); !checked) return checked.error();
  if (const Status checked = checkRaster(description, *ground.value()); !checked) return checked.error();
  if (const Status checked = checkStands(description, *ground.value()); !checked) return checked.error();
  auto stock = stockRocks(description, cache, progress);
  if (!stock) return stock.error();
  hash.add(stock.value().hash);
  return Scene{std::move(description), origin, std::move(ground).value(), std::move(stock).value(), hash.hex()};
}

}  // namespace cairn::rockfall
