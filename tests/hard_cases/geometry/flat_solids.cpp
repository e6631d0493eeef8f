// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "family_demands.h"
#include "geometry_cases.h"

// A square folded onto itself has no inside; the same square a ten-millionth thick has one, a sheet that floats can
// hardly tell from the square.
//
//     +--------------+         +--------------+
//     |==============|  h = 0  |--------------|  h = 1e-7
//     +--------------+         +--------------+
namespace cairn::hard {
namespace {

/// Two sides of one triangle, in the plane z = 0 or across all axes.
builder::TriangleMesh folded(const std::array<Vec3d, 3>& corners) {
  builder::TriangleMesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  return mesh;
}

Outcome runFlatSolids(Effort effort) {
  FamilyDemands demands(effort, 60);
  demands.refuses(demands.import("flat.obj", test::objText(folded({Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}))), "flat");
  demands.refuses(
      demands.import("tilted.obj", test::objText(folded({Vec3d{0.1, 0.2, 0.3}, {1.7, 0.1, 0.9}, {0.3, 1.1, 2.3}}))),
      "flat");
  builder::TriangleMesh pressed = test::meshOf(test::cuboid({1, 1, 1}, 2));
  for (Vec3d& v : pressed.vertices) v.z = 0;
  demands.refuses(builder::buildTree(pressed, demands.options()), "no area");

  Outcome outcome;
  for (const double thickness : {1e-3, 1e-5, 1e-7}) {
    const builder::TriangleMesh sheet = test::meshOf(test::cuboid({1, 1, thickness}, 4));
    const auto tree = demands.build(sheet);
    if (!tree) continue;
    // A ball that holds a part of the sheet stands off by its radius: with 64 leaves of it, each about a hypotenuse of
    // an eighth of a side, half of it.
    outcome.measures.push_back(
        {"worst error of level 2, sheet of " + std::to_string(int(std::log10(thickness))) + " powers of ten",
         100 * double(tree->levelError(2)) / builder::boundsOf(sheet).diagonal(), 12.5, Bound::atMost, "% of size", "",
         0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase flatSolids() {
  return {
      "G5", "flat mesh, sheets",
      "no volume: refused by that name; a sheet down to a ten-millionth thick: a tree that covers it (proposed list) "
      "with balls no larger than twice those of a grid of 8 by 8, 1/16 of the size each",
      runFlatSolids};
}

}  // namespace cairn::hard
