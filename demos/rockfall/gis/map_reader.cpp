// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/map_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {
namespace {

struct Box {
  MapPoint lower{1e300, 1e300}, upper{-1e300, -1e300};

  void add(const std::vector<MapPoint>& points) {
    for (const MapPoint& point : points)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        lower[axis] = std::min(lower[axis], point[axis]);
        upper[axis] = std::max(upper[axis], point[axis]);
      }
  }
};

bool has(const MapFeature& feature, Shape shape) {
  if (shape == Shape::point) return !feature.points.empty();
  return shape == Shape::line ? !feature.lines.empty() : !feature.areas.empty();
}

constexpr std::array kShapes{Shape::point, Shape::line, Shape::area};
constexpr std::array kShapeNames{"points", "lines", "polygons"};

std::string namesOf(std::initializer_list<Shape> shapes) {
  std::string names;
  for (const Shape shape : shapes)
    names += (names.empty() ? "" : " or ") + std::string(kShapeNames[static_cast<std::size_t>(shape)]);
  return names;
}

/// All features of one shape, of those that are asked for.
Status checkShapes(const MapLayer& layer, std::initializer_list<Shape> asked) {
  std::optional<Shape> found;
  for (const MapFeature& feature : layer.features)
    for (const Shape shape : kShapes) {
      if (!has(feature, shape)) continue;
      const char* const name = kShapeNames[static_cast<std::size_t>(shape)];
      if (std::ranges::find(asked, shape) == asked.end())
        return Error{fmt::format("feature {}: it has {}, where only {} can be", feature.id, name, namesOf(asked))};
      if (found && *found != shape)
        return Error{fmt::format("feature {}: it has {}, others have {}: give them as layers of their own", feature.id,
                                 name, kShapeNames[static_cast<std::size_t>(*found)])};
      found = shape;
    }
  if (found) return {};
  return Error{fmt::format(
      "holds no {}{}", namesOf(asked),
      layer.withoutPlace > 0 ? fmt::format(": none of its {} features has a place", layer.withoutPlace) : "")};
}

}  // namespace

bool MapBounds::mayMeet(const MapFeature& feature) const {
  Box box;
  box.add(feature.points);
  for (const Polyline& line : feature.lines) box.add(line);
  for (const Area& area : feature.areas) box.add(area.outline);
  return box.lower[0] < upper[0] && box.lower[1] < upper[1] && box.upper[0] >= lower[0] && box.upper[1] >= lower[1];
}

MapReader::MapReader(const Case& description, const MapTerrain& terrain)
    : description_(description), terrain_(terrain) {
  const bullet::TerrainGrid& grid = terrain.grid;
  bounds_.lower = {grid.origin.x, grid.origin.y};
  bounds_.upper = {grid.origin.x + grid.cell * (grid.columns - 1), grid.origin.y + grid.cell * (grid.rows - 1)};
}

Error MapReader::refused(const MapSource& source, const std::string& why) {
  return Error{fmt::format("{}/{}: {} {}", source.path, source.isRaster ? "raster" : "vector", source.file, why)};
}

Result<MapLayer> MapReader::layer(const MapSource& source, std::initializer_list<Shape> shapes,
                                  const std::string& field) const {
  auto layer = readMapLayer({description_.pathOf(source.file), source.layer, field, terrain_.projection});
  if (!layer) return Error{source.path + "/vector: " + layer.error().message};
  if (const Status checked = checkShapes(layer.value(), shapes); !checked)
    return refused(source, checked.error().message);
  if (std::ranges::none_of(layer.value().features, [&](const MapFeature& f) { return bounds_.mayMeet(f); }))
    return refused(source, fmt::format("lies wholly outside the terrain, which covers x from {:.10g} to {:.10g} and y "
                                       "from {:.10g} to {:.10g}: is it of another place, or its coordinate system "
                                       "not the one it says?",
                                       bounds_.lower[0], bounds_.upper[0], bounds_.lower[1], bounds_.upper[1]));
  return layer;
}

Result<Raster> MapReader::raster(const MapSource& source) const {
  auto raster = readRaster(description_.pathOf(source.file));
  if (!raster) return Error{source.path + "/raster: " + raster.error().message};
  const std::string& own = raster.value().projection;
  if (!own.empty() && !terrain_.projection.empty() && !isSameProjection(own, terrain_.projection))
    return refused(source, fmt::format("is in {}, the terrain in {}: warp it first, by gdalwarp -r near -t_srs",
                                       nameOfProjection(own), nameOfProjection(terrain_.projection)));
  if (!own.empty() && terrain_.projection.empty())
    return refused(source, fmt::format("is in {}, but the terrain does not say in which coordinates it is: give its "
                                       "\"crs\" under /terrain, as in \"crs\": \"EPSG:2056\"",
                                       nameOfProjection(own)));
  return raster;
}

MapNote MapReader::note(const MapSource& source, const MapLayer& layer) const {
  const auto beyond =
      std::ranges::count_if(layer.features, [&](const MapFeature& feature) { return !bounds_.mayMeet(feature); });
  std::string text = fmt::format("{}: {} features", source.file, layer.features.size());
  if (beyond > 0) text += fmt::format(", {} of them beyond the terrain", beyond);
  if (layer.withoutPlace > 0) text += fmt::format(", and {} without a place left out", layer.withoutPlace);
  if (!layer.reprojectedFrom.empty()) text += ", reprojected from " + layer.reprojectedFrom;
  return {source.path, text};
}

MapNote MapReader::note(const MapSource& source, const Raster& raster) const {
  return {source.path,
          fmt::format("{}: {} x {} cells of {:g} m", source.file, raster.columns, raster.rows, raster.cell)};
}

std::string classOfCell(double value) {
  return fmt::format("{}", value + 0.0);  // no negative zero
}

}  // namespace cairn::rockfall
