// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "rockfall/case/cursor.h"

namespace cairn::rockfall {

/// A point of the map: metres, x and y of the world.
using MapPoint = std::array<double, 2>;
/// Corners in order; the last is joined to the first. Empty: everywhere.
using Polygon = std::vector<MapPoint>;

/// Corners in order, the last is not joined to the first.
using Polyline = std::vector<MapPoint>;
/// A polygon with holes. Its border belongs to it or not as in `contains`.
struct Area {
  Polygon outline;
  std::vector<Polygon> holes;
};

MapPoint readPoint(const Value& value);
/// Refuses one that crosses itself.
Polygon readPolygon(const Value& value);
/// Reads two corners or more. Refuses neighbours that are the same point.
Polyline readPolyline(const Value& value);
/// The key polygon_m, or everywhere.
Polygon readRegion(Object& object);

/// The first two edges that cross, by the corners they begin at, counted from 0. Quadratic in the corners.
std::optional<std::pair<std::size_t, std::size_t>> crossingEdges(const Polygon& polygon);

/// By the even-odd rule: the polygon may cross itself. Of a border shared by two polygons every point belongs to
/// exactly one. Everything is in an empty polygon. Linear in the corners.
bool contains(const Polygon& polygon, const MapPoint& point);
/// In the outline and in no hole.
bool areaContains(const Area& area, const MapPoint& point);

}  // namespace cairn::rockfall
