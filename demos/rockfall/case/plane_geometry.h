// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "rockfall/case/cursor.h"

namespace cairn::rockfall {

/// A point of the map: metres, x and y of the world.
using MapPoint = std::array<double, 2>;
/// Corners in order; the last is joined to the first. Empty: everywhere.
using Polygon = std::vector<MapPoint>;

MapPoint readPoint(const Value& value);
Polygon readPolygon(const Value& value);
/// The key polygon_m, or everywhere.
Polygon readRegion(Object& object);

/// By the even-odd rule: the polygon may cross itself. Of a border shared by two polygons every point belongs to
/// exactly one. Everything is in an empty polygon. Linear in the corners.
bool contains(const Polygon& polygon, const MapPoint& point);

}  // namespace cairn::rockfall
