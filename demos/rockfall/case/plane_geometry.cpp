// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/plane_geometry.h"

#include <algorithm>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxCorners = 10000;

}  // namespace

MapPoint readPoint(const Value& value) {
  const auto items = value.items(2, 2);
  if (items.size() != 2) return {};
  return {items[0].number(between(-1e7, 1e7)), items[1].number(between(-1e7, 1e7))};
}

Polygon readPolygon(const Value& value) {
  Polygon polygon;
  for (const Value& corner : value.items(3, kMaxCorners)) polygon.push_back(readPoint(corner));
  return polygon;
}

Polygon readRegion(Object& object) {
  const auto polygon = object.find("polygon_m");
  return polygon ? readPolygon(*polygon) : Polygon();
}

bool contains(const Polygon& polygon, const MapPoint& point) {
  if (polygon.empty()) return true;
  bool isInside = false;
  for (std::size_t i = 0, last = polygon.size() - 1; i < polygon.size(); last = i++) {
    // From the lower to the upper corner, so that both neighbours of a border round alike.
    const auto& [a, b] =
        std::minmax(polygon[last], polygon[i], [](const MapPoint& p, const MapPoint& q) { return p[1] < q[1]; });
    if (a[1] <= point[1] && point[1] < b[1] && point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      isInside = !isInside;
  }
  return isInside;
}

}  // namespace cairn::rockfall
