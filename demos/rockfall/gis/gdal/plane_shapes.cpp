// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/gdal/plane_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "rockfall/terrain/gdal/quiet.h"

namespace cairn::rockfall {
namespace {

constexpr double kFarthest = 1e7;  // m; as of places in a case
/// 1/m. The last bits of a reprojection are its library's; coarser ones are the same for all of its versions.
constexpr double kRounding = 1e4;

class Shapes {
 public:
  Shapes(bool isRounded, MapFeature& feature) : isRounded_(isRounded), feature_(feature) {}

  Status add(const OGRGeometry& geometry) {
    switch (wkbFlatten(geometry.getGeometryType())) {
      case wkbPoint:
        return addPoint(*geometry.toPoint());
      case wkbLineString:
        return addLine(*geometry.toLineString());
      case wkbPolygon:
        return addArea(*geometry.toPolygon());
      case wkbMultiPoint:
      case wkbMultiLineString:
      case wkbMultiPolygon:
      case wkbGeometryCollection:
        for (const OGRGeometry* part : *geometry.toGeometryCollection())
          if (const Status added = add(*part); !added) return added;
        return {};
      default:
        return Error{fmt::format("a {} is no point, line or polygon", geometry.getGeometryName())};
    }
  }

 private:
  Result<MapPoint> place(const OGRPoint& point) const {
    MapPoint at{point.getX(), point.getY()};
    if (isRounded_)
      for (double& coordinate : at) coordinate = std::round(coordinate * kRounding) / kRounding;
    // False for NaN.
    if (std::abs(at[0]) <= kFarthest && std::abs(at[1]) <= kFarthest) return at;
    return Error{fmt::format("its place ({:.10g}, {:.10g}) is on no map in metres", at[0], at[1])};
  }
  Result<Polyline> corners(const OGRSimpleCurve& curve) const {
    Polyline corners;
    for (const OGRPoint& point : curve) {
      const auto at = place(point);
      if (!at) return at.error();
      if (corners.empty() || corners.back() != at.value()) corners.push_back(at.value());
    }
    return corners;
  }
  Result<Polygon> ring(const OGRSimpleCurve& curve) const {
    auto polygon = corners(curve);
    if (!polygon) return polygon.error();
    if (polygon.value().size() > 1 && polygon.value().front() == polygon.value().back()) polygon.value().pop_back();
    return polygon;
  }

  Status addPoint(const OGRPoint& point) {
    if (point.IsEmpty()) return {};
    const auto at = place(point);
    if (!at) return at.error();
    feature_.points.push_back(at.value());
    return {};
  }
  Status addLine(const OGRLineString& curve) {
    auto line = corners(curve);
    if (!line) return line.error();
    if (line.value().size() > 1) feature_.lines.push_back(std::move(line).value());
    return {};
  }
  Status addArea(const OGRPolygon& polygon) {
    if (polygon.IsEmpty()) return {};
    Area area;
    for (const OGRLinearRing* curve : polygon) {
      auto own = ring(*curve);
      if (!own) return own.error();
      if (own.value().size() < 3) {
        if (area.outline.empty()) return {};  // no larger than a line
        continue;
      }
      (area.outline.empty() ? area.outline : area.holes.emplace_back()) = std::move(own).value();
    }
    feature_.areas.push_back(std::move(area));
    return {};
  }

  bool isRounded_;
  MapFeature& feature_;
};

}  // namespace

Status addShapes(const OGRGeometry& geometry, OGRCoordinateTransformation* reprojection, MapFeature& feature) {
  std::unique_ptr<OGRGeometry> plane(geometry.hasCurveGeometry() ? geometry.getLinearGeometry() : geometry.clone());
  plane->flattenTo2D();
  // Numbers first: of NaN a reprojection says nothing that helps.
  MapFeature asWritten;
  if (const Status numbers = Shapes(false, asWritten).add(*plane); !numbers) return numbers;
  if (reprojection && plane->transform(reprojection) != OGRERR_NONE)
    return Error{"it cannot be reprojected: " + Quiet::said()};
  CPLErrorReset();
  if (!plane->IsValid()) return Error{"it crosses or touches itself: " + Quiet::said()};
  return Shapes(reprojection != nullptr, feature).add(*plane);
}

}  // namespace cairn::rockfall
