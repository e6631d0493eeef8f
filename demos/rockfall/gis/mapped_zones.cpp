// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/mapped_zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn::rockfall {
namespace {

Result<std::optional<MaterialId>> materialOf(const MappedZones& zones, const std::optional<std::string>& name) {
  if (zones.only) return zones.only;
  return meaningOf(zones.materials, name.value_or(""));
}

Status addPolygons(const MapReader& reader, const MappedZones& zones, Case& description) {
  auto layer = reader.layer(zones.map, {Shape::area}, zones.materials.field);
  if (!layer) return layer.error();
  description.notes.push_back(reader.note(zones.map, layer.value()));
  for (MapFeature& feature : layer.value().features) {
    if (!reader.bounds().mayMeet(feature)) continue;
    const auto material = materialOf(zones, feature.text);
    if (!material)
      return MapReader::refused(zones.map, fmt::format("feature {}: {}", feature.id, material.error().message));
    if (!material.value()) continue;
    for (Area& area : feature.areas) {
      description.terrain.zones.push_back(makeZone(*material.value(), std::move(area)));
      description.terrain.zones.back().item = zones.item;
    }
  }
  return {};
}

Status addCells(const MapReader& reader, const MappedZones& zones, Case& description) {
  const auto read = reader.raster(zones.map);
  if (!read) return read.error();
  const Raster& raster = read.value();
  MaterialGrid grid{
      raster.columns, raster.rows, raster.cell, {raster.x - raster.cell / 2, raster.y - raster.cell / 2}, {}};
  grid.materials.reserve(raster.values.size());
  std::map<double, MaterialId> known;  // classes repeat
  for (const double value : raster.values) {
    if (std::isnan(value)) {
      grid.materials.push_back(MaterialGrid::kNone);
      continue;
    }
    auto found = known.find(value);
    if (found == known.end()) {
      const auto material = materialOf(zones, classOfCell(value));
      if (!material) return MapReader::refused(zones.map, "in a cell: " + material.error().message);
      found = known.emplace(value, material.value().value_or(MaterialGrid::kNone)).first;
    }
    grid.materials.push_back(found->second);
  }
  Zone zone;
  zone.item = zones.item;
  zone.lower = grid.cornerM;
  zone.upper = {grid.cornerM[0] + grid.cellM * grid.columns, grid.cornerM[1] + grid.cellM * grid.rows};
  zone.grid = std::move(grid);
  description.terrain.zones.push_back(std::move(zone));
  description.notes.push_back(reader.note(zones.map, raster));
  return {};
}

}  // namespace

Status readZones(const MapReader& reader, Case& description) {
  const std::vector<MappedZones> mapped = std::exchange(description.terrain.mapped, {});
  for (const MappedZones& zones : mapped) {
    const Status added =
        zones.map.isRaster ? addCells(reader, zones, description) : addPolygons(reader, zones, description);
    if (!added) return added;
  }
  std::ranges::stable_sort(description.terrain.zones, {}, &Zone::item);
  return {};
}

}  // namespace cairn::rockfall
