// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/primitive_meshes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "surface/icosphere.h"

namespace cairn::builder {

TriangleMesh boxMesh(const Vec3d& edges) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back({(corner & 1 ? 0.5 : -0.5) * edges.x, (corner & 2 ? 0.5 : -0.5) * edges.y,
                             (corner & 4 ? 0.5 : -0.5) * edges.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh prismMesh(double cornerRadius, double length) {
  constexpr std::uint32_t kSides = kPrismSides, kBottom = 2 * kSides, kTop = kBottom + 1;
  TriangleMesh mesh;
  for (const double z : {-0.5 * length, 0.5 * length})
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      mesh.vertices.push_back({cornerRadius * std::cos(angle), cornerRadius * std::sin(angle), z});
    }
  mesh.vertices.push_back({0, 0, -0.5 * length});
  mesh.vertices.push_back({0, 0, 0.5 * length});
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides;
    mesh.triangles.push_back({i, j, j + kSides});
    mesh.triangles.push_back({i, j + kSides, i + kSides});
    mesh.triangles.push_back({j, i, kBottom});
    mesh.triangles.push_back({i + kSides, j + kSides, kTop});
  }
  return mesh;
}

double radiusAround(double cylinderRadius) {
  // A last bit more, so that rounding leaves no side inside the cylinder.
  return cylinderRadius / std::cos(std::numbers::pi / kPrismSides) * (1 + 0x1p-50);
}

RobotSolid primitiveSolid(const CollisionShape& shape, Objective objective) {
  RobotSolid result;
  if (shape.kind == CollisionKind::box) {
    result.name = fmt::format("box {:.4g} x {:.4g} x {:.4g}", shape.size.x, shape.size.y, shape.size.z);
    result.source = SolidSource::box;
    result.surface = result.solid = boxMesh(shape.size);
  } else {
    const double radius = shape.size.x, length = shape.size.y;
    result.name = fmt::format("cylinder {:.4g} x {:.4g}", radius, length);
    result.source = SolidSource::cylinder;
    result.surface = prismMesh(radius, length);
    result.solid = objective == Objective::inner ? result.surface : prismMesh(radiusAround(radius), length);
    result.offOriginal = radiusAround(radius) - radius;
  }
  result.surface.name = result.solid.name = result.name;
  return result;
}

TriangleMesh keptSurface(const CollisionShape& shape) {
  if (shape.kind == CollisionKind::box) return boxMesh(shape.size);
  if (shape.kind == CollisionKind::cylinder) return prismMesh(shape.size.x, shape.size.y);
  constexpr int kSubdivisions = 3;  // 1280 triangles, within 1 % of the radius
  TriangleMesh mesh = unitIcosphere(kSubdivisions);
  for (Vec3d& v : mesh.vertices) v *= shape.size.x * (1 - 0x1p-50);
  return mesh;
}

}  // namespace cairn::builder
