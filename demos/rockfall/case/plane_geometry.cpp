// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/plane_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxCorners = 10000;

// Positive where c lies to the left of the way from a to b.
double side(const MapPoint& a, const MapPoint& b, const MapPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool areApart(const MapPoint& a, const MapPoint& b, const MapPoint& c, const MapPoint& d) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis]) ||
        std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]))
      return true;
  return false;
}

// In a point inside both: edges that only touch do not cross.
bool cross(const MapPoint& a, const MapPoint& b, const MapPoint& c, const MapPoint& d) {
  return !areApart(a, b, c, d) && side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool isFlat(const Polygon& polygon) {
  const auto far = std::ranges::max_element(polygon, {}, [&](const MapPoint& corner) {
    return std::hypot(corner[0] - polygon[0][0], corner[1] - polygon[0][1]);
  });
  return std::ranges::all_of(polygon, [&](const MapPoint& corner) { return side(polygon[0], *far, corner) == 0; });
}

}  // namespace

MapPoint readPoint(const Value& value) {
  const auto items = value.items(2, 2);
  if (items.size() != 2) return {};
  return {items[0].number(between(-1e7, 1e7)), items[1].number(between(-1e7, 1e7))};
}

Polygon readPolygon(const Value& value) {
  Polygon polygon;
  for (const Value& corner : value.items(3, kMaxCorners)) polygon.push_back(readPoint(corner));
  if (const auto edges = crossingEdges(polygon))
    value.refuse(
        fmt::format("the edges from corner {} and from corner {} cross: give the corners in order around the "
                    "area, and two areas as two polygons",
                    edges->first, edges->second));
  else if (!polygon.empty() && isFlat(polygon))
    value.refuse("its corners lie on one line, so that it has no area");
  return polygon;
}

Polyline readPolyline(const Value& value) {
  Polyline line;
  for (const Value& corner : value.items(2, kMaxCorners)) {
    line.push_back(readPoint(corner));
    if (line.size() > 1 && line.back() == line[line.size() - 2])
      value.refuse("two neighbouring ends of the line are the same point");
  }
  return line;
}

Polygon readRegion(Object& object) {
  const auto polygon = object.find("polygon_m");
  return polygon ? readPolygon(*polygon) : Polygon();
}

std::optional<std::pair<std::size_t, std::size_t>> crossingEdges(const Polygon& polygon) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      if (cross(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count])) return std::pair(i, j);
  return {};
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

bool areaContains(const Area& area, const MapPoint& point) {
  return contains(area.outline, point) &&
         std::ranges::none_of(area.holes, [&](const Polygon& hole) { return contains(hole, point); });
}

}  // namespace cairn::rockfall
