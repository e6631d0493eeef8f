// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMostCorners = 10000;

}  // namespace

MapPoint readPoint(const Value& value) {
  const auto items = value.items(2, 2);
  if (items.size() != 2) return {};
  return {items[0].number(between(-1e7, 1e7)), items[1].number(between(-1e7, 1e7))};
}

Polygon readPolygon(const Value& value) {
  Polygon polygon;
  for (const Value& corner : value.items(3, kMostCorners)) polygon.push_back(readPoint(corner));
  return polygon;
}

Polygon readRegion(Object& object) {
  const auto polygon = object.find("polygon_m");
  return polygon ? readPolygon(*polygon) : Polygon();
}

bool contains(const Polygon& polygon, const MapPoint& point) {
  if (polygon.empty()) return true;
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto [xi, yi] = polygon[i];
    const auto [xj, yj] = polygon[j];
    if ((yi > point[1]) != (yj > point[1]) && point[0] < (xj - xi) * (point[1] - yi) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

}  // namespace cairn::rockfall
