// SPDX-License-Identifier: GPL-3.0-or-later
#include <HACD/hacdHACD.h>

#include "scenes/bodies/convex_parts.h"

namespace cairn::scenes {
namespace {

/// HACD scales a mesh to a diagonal of 1000: this is a tenth of the mesh's size, the value of HACD's own example.
constexpr double kConcavity = 100;
constexpr std::size_t kMinParts = 2;
constexpr std::size_t kMaxCorners = 100;  // of a part's hull

std::vector<Vec3d> cornersOf(HACD::HACD& hacd, std::size_t part) {
  std::vector<HACD::Vec3<HACD::Real>> points(hacd.GetNPointsCH(part));
  std::vector<HACD::Vec3<long>> triangles(hacd.GetNTrianglesCH(part));
  hacd.GetCH(part, points.data(), triangles.data());
  std::vector<Vec3d> corners;
  for (const auto& p : points) corners.push_back({p.X(), p.Y(), p.Z()});
  return corners;
}

}  // namespace

Result<std::vector<std::vector<Vec3d>>> convexParts(std::span<const Vec3d> vertices,
                                                    std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<HACD::Vec3<HACD::Real>> points;
  for (const Vec3d& v : vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<HACD::Vec3<long>> faces;
  for (const auto& [a, b, c] : triangles) faces.emplace_back(a, b, c);
  HACD::HACD hacd;
  hacd.SetPoints(points.data());
  hacd.SetNPoints(points.size());
  hacd.SetTriangles(faces.data());
  hacd.SetNTriangles(faces.size());
  hacd.SetNClusters(kMinParts);
  hacd.SetConcavity(kConcavity);
  hacd.SetNVerticesPerCH(kMaxCorners);
  if (!hacd.Compute() || hacd.GetNClusters() == 0) return Error{"HACD found no convex parts of the mesh"};
  std::vector<std::vector<Vec3d>> parts;
  for (std::size_t part = 0; part < hacd.GetNClusters(); ++part) parts.push_back(cornersOf(hacd, part));
  return parts;
}

}  // namespace cairn::scenes
