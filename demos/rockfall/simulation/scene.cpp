// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "rockfall/case/content_hash.h"
#include "rockfall/gis/read_maps.h"
#include "rockfall/simulation/effect_factory.h"
#include "rockfall/simulation/release.h"
#include "rockfall/simulation/world_origin.h"
#include "rockfall/terrain/dams.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {
namespace {

/// Of places of release, by that many drawn ones: below, drawing again would take too long.
constexpr int kTrials = 1000, kMinOverGround = 50;

Status checkHoles(const Release& release, const Ground& ground, std::size_t group) {
  scenes::Random random(0);
  int over = 0;
  for (int trial = 0; trial < kTrials; ++trial) over += ground.covers(drawPlace(release, random));
  if (over >= kMinOverGround) return {};
  return Error{
      fmt::format("/rocks/{}/release: only {:.2g} % of it are over the ground, the rest over holes or beside it", group,
                  100.0 * over / kTrials)};
}

Status checkBox(const Release& release, const Ground& ground, const MapPoint& origin, std::size_t group) {
  const auto& [a, b] = release.boxM;
  for (const MapPoint& corner : {a, b, MapPoint{a[0], b[1]}, MapPoint{b[0], a[1]}})
    if (!ground.covers(corner))
      return Error{
          fmt::format("/rocks/{}/release/box_m: the corner ({:.10g}, {:.10g}) is not over the ground, which covers "
                      "x from {:.10g} to {:.10g} and y from {:.10g} to {:.10g}{}",
                      group, origin[0] + corner[0], origin[1] + corner[1], origin[0] + ground.lower().x,
                      origin[0] + ground.upper().x, origin[1] + ground.lower().y, origin[1] + ground.upper().y,
                      ground.isWithin(corner) ? " but for holes" : "")};
  return {};
}

Status checkEachPlace(const Release& release, const Ground& ground, const MapPoint& origin, std::size_t group) {
  for (std::size_t piece = 0; piece < release.places.pieces().size(); ++piece)
    if (const MapPoint middle = middleOf(release.places, piece); !ground.covers(middle))
      return Error{
          fmt::format("/rocks/{}/release: its place ({:.10g}, {:.10g}) is not over the ground but over a hole: "
                      "leave it out, or give \"count\" in place of \"count_per_place\"",
                      group, origin[0] + middle[0], origin[1] + middle[1])};
  return {};
}

/// A rock that is due after the last step would count as released, and never fall.
Status checkTimes(const Case& description, std::size_t group) {
  const RockGroup& rocks = description.rocks[group];
  const double lastStepS = (description.stepCount() - 0.5) * description.stepS;
  const double lastRockS = (rocks.count - 1) * rocks.release.intervalS;
  if (lastRockS <= lastStepS) return {};
  return Error{fmt::format(
      "/rocks/{}/release: the last of its {} rocks is due at {:g} s, after the run has ended at {:g} s: give "
      "a shorter \"interval_s\", a longer \"duration_s\" or fewer rocks",
      group, rocks.count, lastRockS, description.durationS)};
}

Status checkReleases(const Case& description, const Ground& ground, const MapPoint& origin) {
  for (std::size_t group = 0; group < description.rocks.size(); ++group) {
    const Release& release = description.rocks[group].release;
    if (const Status checked = checkTimes(description, group); !checked) return checked;
    // Places of a map were looked at where it was read.
    if (release.places.empty())
      if (const Status checked = checkBox(release, ground, origin, group); !checked) return checked;
    const bool isEach = description.rocks[group].perPlace > 0;
    const Status checked = isEach ? checkEachPlace(release, ground, origin, group) : checkHoles(release, ground, group);
    if (!checked) return checked;
  }
  return {};
}

// As `contains` and `covers` have it, looked at in as many points as make a cell's width between them, at most this
// many.
constexpr int kMaxPoints = 2000;

bool isSomewhereOver(const Ground& ground, const MapPoint& from, const MapPoint& to) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const int count = std::clamp(static_cast<int>(std::min(length / ground.cellM(), 1e6)) + 1, 1, kMaxPoints);
  for (int i = 0; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    if (ground.covers({from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])})) return true;
  }
  return false;
}

bool isSomewhereOver(const Ground& ground, const std::vector<Polyline>& lines) {
  for (const Polyline& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      if (isSomewhereOver(ground, line[i - 1], line[i])) return true;
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
    if (!isSomewhereOver(ground, description.collectors[i].lines))
      return besideTheGround(fmt::format("/collectors/{}/line_m", i), ground, origin);
  for (std::size_t i = 0; i < description.effects.size(); ++i)
    if (const auto* barrier = std::get_if<BarrierOptions>(&description.effects[i]))
      if (!isSomewhereOver(ground, barrier->lines))
        return besideTheGround(fmt::format("/effects/{}/line_m", i), ground, origin);
  for (std::size_t i = 0; i < description.terrain.zones.size(); ++i) {
    const Zone& zone = description.terrain.zones[i];
    if (zone.area.outline.empty() && !zone.grid) continue;
    const bool isBeside = zone.upper[0] < ground.lower().x || zone.lower[0] > ground.upper().x ||
                          zone.upper[1] < ground.lower().y || zone.lower[1] > ground.upper().y;
    if (isBeside) return besideTheGround(fmt::format("/terrain/zones/{}", zone.item), ground, origin);
  }
  return {};
}

/// Adds what maps held, beside the bytes of their files, because what is read of them may hang on libraries too.
void add(ContentHash& hash, const Polyline& points) {
  hash.add(std::as_bytes(std::span(points)));
}
void addMaps(ContentHash& hash, const Case& description) {
  for (const Zone& zone : description.terrain.zones) {
    hash.add(std::as_bytes(std::span(&zone.material, 1)));
    add(hash, zone.area.outline);
    for (const Polygon& hole : zone.area.holes) add(hash, hole);
    if (zone.grid) hash.add(std::as_bytes(std::span(zone.grid->materials)));
  }
  for (const RockGroup& group : description.rocks) hash.add(std::as_bytes(std::span(group.release.places.pieces())));
  for (const Collector& collector : description.collectors)
    for (const Polyline& line : collector.lines) add(hash, line);
  for (const EffectOptions& effect : description.effects) {
    if (const auto* barrier = std::get_if<BarrierOptions>(&effect))
      for (const Polyline& line : barrier->lines) add(hash, line);
    if (const auto* trees = std::get_if<TreesOptions>(&effect))
      if (const auto* stems = std::get_if<std::vector<Stem>>(&trees->stems)) hash.add(std::as_bytes(std::span(*stems)));
  }
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
  const bool hasMaps = !mapsOf(description).empty();
  if (const Status read = readMaps(description, terrain); !read) return read.error();
  if (const Status raised = raiseDams(description, terrain); !raised) return raised.error();
  bullet::TerrainGrid& grid = terrain.grid;
  const auto worldOrigin = worldOriginOf(grid);
  if (!worldOrigin) return worldOrigin.error();
  const MapPoint& origin = worldOrigin.value();
  ContentHash hash;
  hash.add(description.hash);
  add(hash, grid);
  if (hasMaps) addMaps(hash, description);
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
