// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/models/solids.h"

#include <array>
#include <cmath>
#include <numbers>

namespace cairn::accuracy_cost {
namespace {

using builder::TriangleMesh;

constexpr double kFullTurn = 2 * std::numbers::pi;

/// The two triangles of a quadrilateral.
void addQuad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

std::uint32_t addVertex(TriangleMesh& mesh, const Vec3d& position) {
  mesh.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Adds a circle of radius 1 around the z axis. Returns its first vertex.
std::uint32_t addCircle(TriangleMesh& mesh, double z, std::uint32_t sides) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < sides; ++i)
    addVertex(mesh, {std::cos(kFullTurn * i / sides), std::sin(kFullTurn * i / sides), z});
  return first;
}

/// Adds a fan from `middle` over a circle, counter-clockwise from above if `up`.
void addFan(TriangleMesh& mesh, std::uint32_t middle, std::uint32_t first, std::uint32_t sides, bool up) {
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = first + i, b = first + (i + 1) % sides;
    mesh.triangles.push_back(up ? builder::Triangle{middle, a, b} : builder::Triangle{middle, b, a});
  }
}

}  // namespace

TriangleMesh box(const Vec3d& edges) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i)
    addVertex(mesh, {(i & 1) != 0 ? edges.x : 0, (i & 2) != 0 ? edges.y : 0, (i & 4) != 0 ? edges.z : 0});
  addQuad(mesh, 0, 2, 3, 1);
  addQuad(mesh, 4, 5, 7, 6);
  addQuad(mesh, 0, 1, 5, 4);
  addQuad(mesh, 2, 6, 7, 3);
  addQuad(mesh, 0, 4, 6, 2);
  addQuad(mesh, 1, 3, 7, 5);
  return mesh;
}

TriangleMesh cylinder(double height, std::uint32_t sides) {
  TriangleMesh mesh;
  const std::uint32_t bottom = addCircle(mesh, 0, sides), top = addCircle(mesh, height, sides);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t k = (i + 1) % sides;
    addQuad(mesh, bottom + i, bottom + k, top + k, top + i);
  }
  addFan(mesh, addVertex(mesh, {0, 0, 0}), bottom, sides, false);
  addFan(mesh, addVertex(mesh, {0, 0, height}), top, sides, true);
  return mesh;
}

TriangleMesh cone(double height, std::uint32_t sides) {
  TriangleMesh mesh;
  const std::uint32_t bottom = addCircle(mesh, 0, sides);
  addFan(mesh, addVertex(mesh, {0, 0, 0}), bottom, sides, false);
  addFan(mesh, addVertex(mesh, {0, 0, height}), bottom, sides, true);
  return mesh;
}

TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = kFullTurn * i / around, v = kFullTurn * j / across, ring = major + minor * std::cos(v);
      addVertex(mesh, {ring * std::cos(u), ring * std::sin(u), minor * std::sin(v)});
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t i2 = (i + 1) % around, j2 = (j + 1) % across;
      addQuad(mesh, i * across + j, i2 * across + j, i2 * across + j2, i * across + j2);
    }
  return mesh;
}

TriangleMesh sShape() {
  constexpr std::uint32_t kSides = 16, kRings = 33;
  constexpr double kReach = 225 * std::numbers::pi / 180, kThickness = 0.35;
  // At length s along the S from its middle, the tube points towards (sin |s|, cos |s|). The half with s < 0 mirrors
  // the half with s > 0.
  TriangleMesh mesh;
  std::array<Vec3d, 2> ends;
  for (std::uint32_t i = 0; i < kRings; ++i) {
    const double s = kReach * (2.0 * i / (kRings - 1) - 1), turn = std::abs(s), side = s < 0 ? -1 : 1;
    const double x = side * (1 - std::cos(turn)), y = side * std::sin(turn);
    for (std::uint32_t j = 0; j < kSides; ++j) {
      const double a = kFullTurn * j / kSides, across = kThickness * std::cos(a);
      addVertex(mesh, {x + across * std::cos(turn), y - across * std::sin(turn), kThickness * std::sin(a)});
    }
    if (i == 0) ends[0] = {x, y, 0};
    if (i == kRings - 1) ends[1] = {x, y, 0};
  }
  for (const Vec3d& end : ends) addVertex(mesh, end);
  // Rounds to nine digits, so that the last bit of a library's sine never enters a tree.
  for (Vec3d& v : mesh.vertices)
    v = {std::round(v.x * 1e9) / 1e9, std::round(v.y * 1e9) / 1e9, std::round(v.z * 1e9) / 1e9};
  constexpr std::uint32_t kTube = kRings * kSides;
  for (std::uint32_t j = 0; j < kSides; ++j) {
    const std::uint32_t k = (j + 1) % kSides;
    for (std::uint32_t i = 0; i + 1 < kRings; ++i)
      addQuad(mesh, i * kSides + j, (i + 1) * kSides + j, (i + 1) * kSides + k, i * kSides + k);
    mesh.triangles.push_back({kTube, j, k});
    mesh.triangles.push_back({kTube + 1, kTube - kSides + k, kTube - kSides + j});
  }
  return mesh;
}

}  // namespace cairn::accuracy_cost
