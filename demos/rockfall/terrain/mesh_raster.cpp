// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/mesh_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cairn/builder/import.h"

namespace cairn::rockfall {

namespace {

// How far outside a triangle, in barycentric coordinates, a point may be: on an edge that two share it must not fall
// between them. Its height is then off by as much of the triangle's own.
constexpr double kOutside = 1e-9;

// Twice the area of a triangle seen from above.
double areaFromAbove(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Span {
  std::uint32_t first, last;
};

// The points whose coordinate is within [low, high], one more on each side.
Span pointsWithin(double low, double high, double origin, double cell, std::uint32_t count) {
  const auto place = [&](double at) { return std::clamp(at, 0.0, double(count - 1)); };
  return {static_cast<std::uint32_t>(place(std::floor((low - origin) / cell))),
          static_cast<std::uint32_t>(place(std::ceil((high - origin) / cell)))};
}

void drape(const std::array<Vec3d, 3>& t, Raster& raster) {
  const double area = areaFromAbove(t[0], t[1], t[2]);
  if (area == 0) return;
  const auto [lowX, highX] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [lowY, highY] = std::minmax({t[0].y, t[1].y, t[2].y});
  const Span columns = pointsWithin(lowX, highX, raster.x, raster.cell, raster.columns);
  const Span rows = pointsWithin(lowY, highY, raster.y, raster.cell, raster.rows);
  for (std::uint32_t row = rows.first; row <= rows.last; ++row)
    for (std::uint32_t column = columns.first; column <= columns.last; ++column) {
      const Vec3d p(raster.x + column * raster.cell, raster.y + row * raster.cell, 0);
      const double a = areaFromAbove(p, t[1], t[2]) / area, b = areaFromAbove(t[0], p, t[2]) / area, c = 1 - a - b;
      if (a < -kOutside || b < -kOutside || c < -kOutside) continue;
      double& height = raster.at(column, row);
      const double here = a * t[0].z + b * t[1].z + c * t[2].z;
      if (!(height >= here)) height = here;  // also where there is none yet
    }
}

}  // namespace

Result<Raster> rasterOfMesh(const builder::TriangleMesh& mesh, double cell) {
  if (!(cell > 0) || !std::isfinite(cell))
    return Error{"cannot be sampled every " + std::to_string(cell) + " m: give a positive, finite cell"};
  if (mesh.vertices.empty()) return Error{"has no vertices"};
  const builder::Bounds box = builder::boundsOf(mesh);
  const auto points = [&](double low, double high) { return std::floor((high - low) / cell * (1 + 1e-12)) + 1; };
  const double columns = points(box.lower.x, box.upper.x), rows = points(box.lower.y, box.upper.y);
  constexpr double kMax = 1e15;  // what an integer surely holds
  if (Status status = checkRasterSize(static_cast<std::uint64_t>(std::min(columns, kMax)),
                                      static_cast<std::uint64_t>(std::min(rows, kMax)));
      !status)
    return status.error();
  Raster raster{
      static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), cell, box.lower.x, box.lower.y, {}, {}};
  raster.values.assign(std::size_t(raster.columns) * raster.rows, std::numeric_limits<double>::quiet_NaN());
  drape(mesh, raster);
  return raster;
}

void drape(const builder::TriangleMesh& mesh, Raster& raster) {
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) drape(mesh.corners(i), raster);
}

Result<Raster> readMeshRaster(const std::filesystem::path& path, double cell) {
  const Result<builder::TriangleMesh> mesh = builder::importSurface(path);
  if (!mesh) return mesh.error();
  Result<Raster> raster = rasterOfMesh(mesh.value(), cell);
  if (!raster) return Error{path.string() + " " + raster.error().message};
  return raster;
}

}  // namespace cairn::rockfall
