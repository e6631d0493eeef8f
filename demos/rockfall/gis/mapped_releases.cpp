// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/mapped_releases.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

namespace cairn::rockfall {
namespace {

Status checkWithin(const MapBounds& bounds, std::span<const MapPoint> points) {
  for (const MapPoint& point : points)
    if (!bounds.contains(point))
      return Error{
          fmt::format("its place ({:.10g}, {:.10g}) is outside the terrain, which covers x from {:.10g} to "
                      "{:.10g} and y from {:.10g} to {:.10g}: cut it out, or take a larger terrain",
                      point[0], point[1], bounds.lower[0], bounds.upper[0], bounds.lower[1], bounds.upper[1])};
  return {};
}

Status addFeature(const MapBounds& bounds, const MapFeature& feature, PlaceSet& places) {
  if (const Status within = checkWithin(bounds, feature.points); !within) return within;
  for (const MapPoint& point : feature.points) places.addPoint(point);
  for (const Polyline& line : feature.lines) {
    if (const Status within = checkWithin(bounds, line); !within) return within;
    places.addLine(line);
  }
  for (const Area& area : feature.areas) {
    if (const Status within = checkWithin(bounds, area.outline); !within) return within;
    if (!places.addArea(area)) return Error{"it makes the map too ragged to draw places from: simplify it"};
  }
  return {};
}

Result<PlaceSet> placesOf(const MapReader& reader, const MapSource& source, bool isEach, std::vector<MapNote>& notes) {
  const auto layer = reader.layer(source, {Shape::point, Shape::line, Shape::area}, {});
  if (!layer) return layer.error();
  if (isEach && layer.value().features.front().points.empty())
    return MapReader::refused(source,
                              "holds lines or polygons, and \"count_per_place\" needs single places: give points or a "
                              "raster of cells, or \"count\"");
  PlaceSet places;
  for (const MapFeature& feature : layer.value().features)
    if (const Status added = addFeature(reader.bounds(), feature, places); !added)
      return MapReader::refused(source, fmt::format("feature {}: {}", feature.id, added.error().message));
  notes.push_back(reader.note(source, layer.value()));
  return places;
}

/// The cells of a mask, neighbours along x as one piece.
class Mask {
 public:
  explicit Mask(const Raster& raster) : raster_(raster) {}

  bool isSet(std::uint32_t column, std::uint32_t row) const {
    const double value = raster_.at(column, row);
    return !std::isnan(value) && value != 0;
  }
  MapPoint middle(std::uint32_t column, std::uint32_t row) const {
    return {raster_.x + column * raster_.cell, raster_.y + row * raster_.cell};
  }
  PlaceSet::Piece piece(std::uint32_t from, std::uint32_t to, std::uint32_t row) const {
    const double half = raster_.cell / 2;
    const auto [west, y] = middle(from, row);
    const double east = middle(to, row)[0];
    return {MapPoint{west - half, y - half}, {east + half, y - half}, {west - half, y + half}, {east + half, y + half}};
  }

 private:
  const Raster& raster_;
};

/// `isEach`: every cell by itself.
Result<PlaceSet> cellsOf(const MapReader& reader, const MapSource& source, bool isEach, std::vector<MapNote>& notes) {
  const auto raster = reader.raster(source);
  if (!raster) return raster.error();
  const Mask mask(raster.value());
  PlaceSet places;
  const auto [columns, rows] = std::pair(raster.value().columns, raster.value().rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      if (!mask.isSet(column, row)) continue;
      const std::uint32_t first = column;
      while (!isEach && column + 1 < columns && mask.isSet(column + 1, row)) ++column;
      for (const MapPoint& middle : {mask.middle(first, row), mask.middle(column, row)})
        if (const Status within = checkWithin(reader.bounds(), {&middle, 1}); !within)
          return MapReader::refused(source, "in a cell that is set: " + within.error().message);
      places.add(mask.piece(first, column, row), column - first + 1);
    }
  if (places.empty()) return MapReader::refused(source, "has no cell that is set: all are zero or without a value");
  notes.push_back(reader.note(source, raster.value()));
  return places;
}

}  // namespace

Status readReleases(const MapReader& reader, Case& description) {
  for (RockGroup& group : description.rocks) {
    Release& release = group.release;
    if (!release.map) continue;
    const bool isEach = group.perPlace > 0;
    auto places = release.map->isRaster ? cellsOf(reader, *release.map, isEach, description.notes)
                                        : placesOf(reader, *release.map, isEach, description.notes);
    if (!places) return places.error();
    if (places.value().empty())
      return MapReader::refused(*release.map, "has no size: its lines have no length, or its polygons no area");
    if (isEach) {
      const std::uint64_t count = group.perPlace * std::uint64_t(places.value().pieces().size());
      if (count > kMaxRocks)
        return MapReader::refused(
            *release.map, fmt::format("has {} places, so there would be {} rocks, more than {}: take fewer of each, or "
                                      "a coarser map",
                                      places.value().pieces().size(), count, kMaxRocks));
      group.count = static_cast<std::uint32_t>(count);
    }
    release.places = std::move(places).value();
    release.map.reset();
  }
  return {};
}

}  // namespace cairn::rockfall
