// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/icosphere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cairn::builder {
namespace {

TriangleMesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  for (const Vec3d& v :
       {Vec3d{-1, g, 0}, Vec3d{1, g, 0}, Vec3d{-1, -g, 0}, Vec3d{1, -g, 0}, Vec3d{0, -1, g}, Vec3d{0, 1, g},
        Vec3d{0, -1, -g}, Vec3d{0, 1, -g}, Vec3d{g, 0, -1}, Vec3d{g, 0, 1}, Vec3d{-g, 0, -1}, Vec3d{-g, 0, 1}})
    mesh.vertices.push_back(normalized(v));
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

}  // namespace

TriangleMesh unitIcosphere(int subdivisions) {
  TriangleMesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (isNew) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& part : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) finer.push_back(part);
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace cairn::builder
