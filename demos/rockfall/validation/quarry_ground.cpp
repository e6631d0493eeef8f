// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/quarry_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cairn/builder/import.h"
#include "rockfall/terrain/mesh_raster.h"
#include "rockfall/validation/quarry_data.h"

namespace cairn::rockfall {
namespace {

Result<std::vector<builder::TriangleMesh>> readZones(const std::filesystem::path& folder) {
  std::vector<builder::TriangleMesh> zones;
  for (const GroundZone& zone : kGroundZones) {
    auto mesh = builder::importSurface(folder / zone.file);
    if (!mesh) return mesh.error();
    for (Vec3d& vertex : mesh.value().vertices) vertex = fromData(vertex);
    zones.push_back(std::move(mesh).value());
  }
  return zones;
}

builder::TriangleMesh together(const std::vector<builder::TriangleMesh>& zones) {
  builder::TriangleMesh all;
  for (const builder::TriangleMesh& zone : zones) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), zone.vertices.begin(), zone.vertices.end());
    for (const builder::Triangle& t : zone.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

// The material of each zone in the list.
std::vector<MaterialId> materialsOfZones(const Materials& materials) {
  std::vector<MaterialId> ids;
  for (const GroundZone& zone : kGroundZones)
    ids.push_back(static_cast<MaterialId>(std::ranges::find(materials, zone.material) - materials.begin()));
  return ids;
}

MaterialGrid gridOf(const Raster& heights, const std::vector<builder::TriangleMesh>& zones,
                    const std::vector<MaterialId>& materials) {
  MaterialGrid grid{heights.columns, heights.rows, heights.cell, {}, {}};
  grid.cornerM = {heights.x - heights.cell / 2, heights.y - heights.cell / 2};
  grid.materials.assign(heights.values.size(), materials.front());
  for (std::size_t zone = 0; zone < zones.size(); ++zone) {
    Raster own = heights;
    std::ranges::fill(own.values, std::numeric_limits<double>::quiet_NaN());
    drape(zones[zone], own);
    for (std::size_t i = 0; i < own.values.size(); ++i)
      if (own.values[i] >= heights.values[i]) grid.materials[i] = materials[zone];
  }
  return grid;
}

}  // namespace

Result<QuarryGround> readQuarryGround(const std::filesystem::path& folder, double cellM, const Materials& materials) {
  const auto zones = readZones(folder);
  if (!zones) return zones.error();
  const auto raster = rasterOfMesh(together(zones.value()), cellM);
  if (!raster) return Error{"the ground of " + folder.string() + " " + raster.error().message};
  auto terrain = terrainGridOf(raster.value());
  if (!terrain) return Error{"the ground of " + folder.string() + " " + terrain.error().message};
  const std::vector<MaterialId> ids = materialsOfZones(materials);
  QuarryGround ground{{std::move(terrain).value(), {}}, {}};
  ground.section.material = ids.front();
  ground.section.grid = gridOf(raster.value(), zones.value(), ids);
  return ground;
}

}  // namespace cairn::rockfall
