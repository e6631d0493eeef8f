// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/terrain_section.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cairn::rockfall {
namespace {

constexpr double kLongest = 1e5;  // metres
constexpr double kSteepest = 89;  // degrees
constexpr std::size_t kMaxZones = 1000, kMaxProfileCorners = 10000;

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

}  // namespace

Zone makeZone(MaterialId material, Polygon polygon) {
  Zone zone{material, std::move(polygon)};
  if (zone.polygon.empty()) return zone;
  zone.lower = zone.upper = zone.polygon.front();
  for (const MapPoint& corner : zone.polygon)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      zone.lower[axis] = std::min(zone.lower[axis], corner[axis]);
      zone.upper[axis] = std::max(zone.upper[axis], corner[axis]);
    }
  return zone;
}

std::optional<MaterialId> MaterialGrid::at(const MapPoint& point) const {
  const double column = (point[0] - cornerM[0]) / cellM, row = (point[1] - cornerM[1]) / cellM;
  if (!(column >= 0 && column < columns && row >= 0 && row < rows)) return {};
  return materials[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
}

MaterialId TerrainSection::materialAt(const MapPoint& point) const {
  for (auto zone = zones.rbegin(); zone != zones.rend(); ++zone) {
    const bool isInBox = point[0] >= zone->lower[0] && point[0] <= zone->upper[0] && point[1] >= zone->lower[1] &&
                         point[1] <= zone->upper[1];
    if (isInBox && contains(zone->polygon, point)) return zone->material;
  }
  return grid.at(point).value_or(material);
}

TerrainSection readTerrain(const Value& value, const Materials& materials) {
  Object object(value);
  TerrainSection terrain;
  terrain.source = readTerrainSource(object);
  terrain.material = readMaterial(object.at("material"), materials);
  if (const auto zones = object.find("zones"))
    for (const Value& item : zones->items(0, kMaxZones)) {
      Object zone(item);
      const MaterialId material = readMaterial(zone.at("material"), materials);
      terrain.zones.push_back(makeZone(material, readPolygon(zone.at("polygon_m"))));
    }
  return terrain;
}

}  // namespace cairn::rockfall
