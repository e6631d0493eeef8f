// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "cairn/builder/simplify.h"
#include "cairn/builder/triangle_mesh.h"
#include "random_tree.h"
#include "test_solids.h"

namespace cairn::test {

inline builder::TriangleMesh meshOf(const Solid& solid) {
  builder::TriangleMesh mesh;
  mesh.vertices = solid.vertices;
  mesh.triangles.assign(solid.triangles.begin(), solid.triangles.end());
  mesh.name = "test";
  return mesh;
}

/// Moves every vertex by `place`, a function Vec3d -> Vec3d that keeps orientation.
template <class Place>
builder::TriangleMesh moved(builder::TriangleMesh mesh, const Place& place) {
  for (Vec3d& v : mesh.vertices) v = place(v);
  return mesh;
}

inline builder::TriangleMesh flipped(builder::TriangleMesh mesh) {
  for (builder::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Both meshes in one, the second's vertices after the first's.
inline builder::TriangleMesh joined(builder::TriangleMesh a, const builder::TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const builder::Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

/// A ball with dents and bumps: star-shaped, concave, no symmetry.
inline builder::TriangleMesh lumpyBall(int subdivisions, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  builder::TriangleMesh mesh = meshOf(ball(1, subdivisions));
  for (Vec3d& v : mesh.vertices) v *= uniform(engine, 0.7, 1.0);
  return mesh;
}

/// A ring of `around` segments with a round section of `across` sides; axis z.
inline builder::TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
  builder::TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double ring = major + minor * std::cos(v);
      mesh.vertices.push_back({ring * std::cos(u), ring * std::sin(u), minor * std::sin(v)});
      const std::uint32_t i2 = (i + 1) % around, j2 = (j + 1) % across;
      const std::uint32_t a = i * across + j, b = i2 * across + j, c = i2 * across + j2, d = i * across + j2;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// A cylinder of `sides` flat sides around the origin; axis z.
inline builder::TriangleMesh cylinder(double radius, double height, std::uint32_t sides) {
  builder::TriangleMesh mesh;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double u = 2 * std::numbers::pi * i / sides;
      mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), z});
    }
  mesh.vertices.push_back({0, 0, -0.5 * height});
  mesh.vertices.push_back({0, 0, 0.5 * height});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    mesh.triangles.push_back({i, j, j + sides});
    mesh.triangles.push_back({i, j + sides, i + sides});
    mesh.triangles.push_back({j, i, 2 * sides});
    mesh.triangles.push_back({i + sides, j + sides, 2 * sides + 1});
  }
  return mesh;
}

using builder::objText;

inline std::filesystem::path writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

}  // namespace cairn::test
