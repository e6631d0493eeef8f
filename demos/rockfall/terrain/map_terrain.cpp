// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/map_terrain.h"

#include <utility>

#include "rockfall/terrain/generated.h"
#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/height_traps.h"
#include "rockfall/terrain/mesh_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {

namespace {

Result<MapTerrain> terrainFrom(const Result<Raster>& raster, const char* key, const std::filesystem::path& file) {
  if (!raster) return Error{std::string("/terrain/") + key + ": " + raster.error().message};
  const Raster& values = raster.value();
  const auto refused = [&](const std::string& why) {
    return Error{std::string("/terrain/") + key + ": " + file.string() + " " + why};
  };
  if (values.columns < 2 || values.rows < 2)
    return refused("has " + std::to_string(values.columns) + " x " + std::to_string(values.rows) +
                   " values: a terrain needs at least two a side");
  if (const auto why = whyNoHeights(values)) return refused(*why);
  auto grid = terrainGridOf(values);
  if (!grid) return refused(grid.error().message);
  return MapTerrain{std::move(grid).value(), values.projection};
}

struct Source {
  const Case& scene;

  Result<MapTerrain> operator()(const RasterTerrain& raster) const {
    const std::filesystem::path file = scene.pathOf(raster.file);
    return terrainFrom(readRaster(file), "raster", file);
  }
  Result<MapTerrain> operator()(const MeshTerrain& mesh) const {
    const std::filesystem::path file = scene.pathOf(mesh.file);
    return terrainFrom(readMeshRaster(file, mesh.cellM), "mesh", file);
  }
  Result<MapTerrain> operator()(const auto& generated) const {
    auto grid = generateTerrain(generated, scene.seed);
    if (!grid) return grid.error();
    return MapTerrain{std::move(grid).value(), {}};
  }
};

/// What the case says of the projection, where the file says nothing else.
Status addProjection(const std::string& crs, MapTerrain& terrain) {
  auto named = projectionNamed(crs);
  if (!named) return Error{"/terrain/crs: \"" + crs + "\" " + named.error().message};
  if (!terrain.projection.empty() && !isSameProjection(terrain.projection, named.value()))
    return Error{"/terrain/crs: the terrain's file says that it is in " + nameOfProjection(terrain.projection) +
                 ", not in \"" + crs + "\": leave one of them out"};
  terrain.projection = std::move(named).value();
  return {};
}

}  // namespace

Result<MapTerrain> terrainOf(const Case& scene) {
  auto terrain = std::visit(Source{scene}, scene.terrain.source);
  if (!terrain || !scene.terrain.crs) return terrain;
  if (const Status added = addProjection(*scene.terrain.crs, terrain.value()); !added) return added.error();
  return terrain;
}

}  // namespace cairn::rockfall
