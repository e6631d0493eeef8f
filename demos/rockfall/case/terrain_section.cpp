// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/terrain_section.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cairn::rockfall {
namespace {

constexpr double kLongest = 1e5;  // metres
constexpr double kSteepest = 89;  // degrees
constexpr std::size_t kMaxZones = 1000, kMaxDams = 100, kMaxProfileCorners = 10000;

GeneratedGrid readGrid(Object& object) {
  return {object.at("width_m").number({0, kLongest, true}), object.numberOr("cell_m", {0.01, 1000}, 1),
          object.numberOr("roughness_m", between(0, 100), 0)};
}

double readLength(Object& object) {
  return object.at("length_m").number({0, kLongest, true});
}

TerrainSource readPlane(Object& object) {
  const GeneratedGrid grid = readGrid(object);
  const double length = readLength(object);
  return PlaneTerrain{grid, length, object.at("slope_deg").number(between(0, kSteepest))};
}

TerrainSource readSteppedSlope(Object& object) {
  SteppedSlopeTerrain slope{readGrid(object), {}, object.numberOr("bank_m", between(0, 100), 0)};
  for (const Value& corner : object.at("profile_m").items(2, kMaxProfileCorners)) {
    slope.profileM.push_back(readPoint(corner));
    if (slope.profileM.size() > 1 && slope.profileM.back()[0] <= slope.profileM[slope.profileM.size() - 2][0])
      corner.refuse("the x of a profile must rise from point to point");
  }
  return slope;
}

TerrainSource readChannel(Object& object) {
  const GeneratedGrid grid = readGrid(object);
  const double length = readLength(object);
  const double slope = object.at("slope_deg").number(between(0, kSteepest));
  return ChannelTerrain{grid, length, slope, object.at("depth_m").number({0, kLongest, true})};
}

TerrainSource readTalusCone(Object& object) {
  const GeneratedGrid grid = readGrid(object);
  const double height = object.at("height_m").number({0, kLongest, true});
  return TalusConeTerrain{grid, height, object.at("slope_deg").number({0, kSteepest, true})};
}

struct Generator {
  std::string_view name;
  TerrainSource (*read)(Object&);
};
constexpr std::array kGenerators{Generator{"plane", readPlane}, Generator{"stepped_slope", readSteppedSlope},
                                 Generator{"channel", readChannel}, Generator{"talus_cone", readTalusCone}};

TerrainSource readGenerated(const Value& kind, Object& object) {
  std::array<std::string_view, kGenerators.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kGenerators[i].name;
  return kGenerators[kind.choice(names, "generated terrain")].read(object);
}

TerrainSource readTerrainSource(Object& object) {
  const auto generated = object.find("generated"), raster = object.find("raster"), mesh = object.find("mesh");
  if (generated.has_value() + raster.has_value() + mesh.has_value() != 1) {
    object.refuse("exactly one of \"generated\", \"raster\" and \"mesh\" must be given");
    return {};
  }
  if (raster) return RasterTerrain{raster->text()};
  if (mesh) return MeshTerrain{mesh->text(), object.at("cell_m").number({0.01, 1000})};
  return readGenerated(*generated, object);
}

MappedZones readMappedZones(Object& object, std::size_t item, const Materials& materials) {
  MappedZones zones{readMapSource(object), item, {}, {}};
  const auto material = object.find("material");
  const auto read = [&](const Value& value) { return readMaterial(value, materials); };
  if (material)
    zones.only = read(*material);
  else
    zones.materials = readClasses<MaterialId>(object, zones.map, "materials", read);
  return zones;
}

void readZone(const Value& value, std::size_t item, const Materials& materials, TerrainSection& terrain) {
  Object object(value);
  if (namesMap(object)) {
    terrain.mapped.push_back(readMappedZones(object, item, materials));
    return;
  }
  const MaterialId material = readMaterial(object.at("material"), materials);
  terrain.zones.push_back(makeZone(material, {readPolygon(object.at("polygon_m")), {}}));
  terrain.zones.back().item = item;
}

Dam readDam(const Value& value) {
  Object object(value);
  const PlacedLines placed = readLines(object);
  Dam dam{placed.lines,
          placed.map,
          object.at("height_m").number({0, 100, true}),
          object.numberOr("crest_m", between(0, 100), 0),
          {}};
  const Value slopes = object.at("slope_deg");
  if (const auto sides = slopes.items(2, 2); sides.size() == 2)
    for (std::size_t side = 0; side < 2; ++side) dam.slopeDeg[side] = sides[side].number(between(10, kSteepest));
  return dam;
}

}  // namespace

Zone makeZone(MaterialId material, Area area) {
  Zone zone{material, std::move(area), {}, {}, 0, {}};
  if (zone.area.outline.empty()) return zone;
  zone.lower = zone.upper = zone.area.outline.front();
  for (const MapPoint& corner : zone.area.outline)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      zone.lower[axis] = std::min(zone.lower[axis], corner[axis]);
      zone.upper[axis] = std::max(zone.upper[axis], corner[axis]);
    }
  return zone;
}

std::optional<MaterialId> MaterialGrid::at(const MapPoint& point) const {
  const double column = (point[0] - cornerM[0]) / cellM, row = (point[1] - cornerM[1]) / cellM;
  if (!(column >= 0 && column < columns && row >= 0 && row < rows)) return {};
  const MaterialId material = materials[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
  return material == kNone ? std::nullopt : std::optional(material);
}

std::optional<MaterialId> Zone::at(const MapPoint& point) const {
  if (grid) return grid->at(point);
  const bool isInBox = point[0] >= lower[0] && point[0] <= upper[0] && point[1] >= lower[1] && point[1] <= upper[1];
  return isInBox && areaContains(area, point) ? std::optional(material) : std::nullopt;
}

MaterialId TerrainSection::materialAt(const MapPoint& point) const {
  for (auto zone = zones.rbegin(); zone != zones.rend(); ++zone)
    if (const auto found = zone->at(point)) return *found;
  return grid.at(point).value_or(material);
}

TerrainSection readTerrain(const Value& value, const Materials& materials) {
  Object object(value);
  TerrainSection terrain;
  terrain.source = readTerrainSource(object);
  terrain.material = readMaterial(object.at("material"), materials);
  if (const auto crs = object.find("crs")) terrain.crs = crs->text();
  if (const auto zones = object.find("zones")) {
    const std::vector<Value> items = zones->items(0, kMaxZones);
    for (std::size_t i = 0; i < items.size(); ++i) readZone(items[i], i, materials, terrain);
  }
  if (const auto dams = object.find("dams"))
    for (const Value& item : dams->items(0, kMaxDams)) terrain.dams.push_back(readDam(item));
  return terrain;
}

}  // namespace cairn::rockfall
