// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/solids.h"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "builder_meshes.h"

namespace cairn::bench {
namespace {

/// Borders of cells along each axis.
using Borders = std::array<std::vector<double>, 3>;
/// Whether the cell with these numbers is solid.
using IsSolid = std::function<bool(std::size_t x, std::size_t y, std::size_t z)>;

/// The surface of the solid cells of a grid. Closed; precondition: solid cells that share an edge share a face.
builder::TriangleMesh meshOfCells(const Borders& borders, const IsSolid& isSolid) {
  test::detail::SolidWriter out;
  const auto at = [&](const std::array<std::size_t, 3>& i) {
    return Vec3d(borders[0][i[0]], borders[1][i[1]], borders[2][i[2]]);
  };
  const auto solidAt = [&](const std::array<std::size_t, 3>& i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (i[axis] >= borders[axis].size() - 1) return false;  // also below 0, which wraps around to a large number
    return isSolid(i[0], i[1], i[2]);
  };
  for (std::size_t x = 0; x + 1 < borders[0].size(); ++x)
    for (std::size_t y = 0; y + 1 < borders[1].size(); ++y)
      for (std::size_t z = 0; z + 1 < borders[2].size(); ++z) {
        const std::array<std::size_t, 3> cell{x, y, z};
        if (!solidAt(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
          std::array<std::size_t, 3> u = cell, v = cell, below = cell, above = cell;
          ++u[second];
          ++v[third];
          --below[axis];
          ++above[axis];
          const Vec3d alongU = at(u) - at(cell), alongV = at(v) - at(cell);
          if (!solidAt(below)) out.patch(at(cell), alongV, alongU, 1, 1);
          if (!solidAt(above)) out.patch(at(above), alongU, alongV, 1, 1);
        }
      }
  return test::meshOf(out.solid);
}

builder::TriangleMesh block(double x, double y, double z) {
  return meshOfCells({{{0, x}, {0, y}, {0, z}}}, [](auto...) { return true; });
}

/// Ten high, ten wide and a hundred long; flanges and web are one thick.
builder::TriangleMesh iBeam() {
  return meshOfCells({{{0, 4.5, 5.5, 10}, {0, 100}, {0, 1, 9, 10}}},
                     [](std::size_t x, std::size_t, std::size_t z) { return z != 1 || x == 1; });
}

/// In centimetres: four legs, a seat, two posts and a board between them.
builder::TriangleMesh chair() {
  return meshOfCells({{{0, 4, 41, 45}, {0, 4, 41, 45}, {0, 42, 45, 70, 90}}},
                     [](std::size_t x, std::size_t y, std::size_t z) {
                       const bool isSide = x != 1, isFront = y == 0, isBack = y == 2;
                       if (z == 0) return isSide && (isFront || isBack);
                       if (z == 1) return true;
                       return isBack && (isSide || z == 3);
                     });
}

/// An ellipsoid with shallow dents.
builder::TriangleMesh rock() {
  return test::moved(test::meshOf(test::ball(1, 10)), [](const Vec3d& v) {
    const double dents = 1 + 0.06 * std::sin(5 * v.x + 1) * std::cos(4 * v.y) + 0.04 * std::sin(6 * v.z + 2 * v.x);
    return Vec3d(1.3 * v.x, v.y, 0.8 * v.z) * dents;
  });
}

}  // namespace

std::vector<NamedMesh> generatedSolids() {
  return {{"rod 1000:1", block(1000, 1, 1)},
          {"plate 1000:1000:1", block(1000, 1000, 1)},
          {"I-beam", iBeam()},
          {"chair", chair()},
          {"ball", test::meshOf(test::ball(1, 8))},
          {"rock", rock()}};
}

}  // namespace cairn::bench
