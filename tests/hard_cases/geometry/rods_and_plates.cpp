// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "builder_meshes.h"
#include "family_demands.h"
#include "geometry_cases.h"

// The worst solids for spheres: a rod a thousand times as long as wide, a plate a thousand times as wide as thick.
//
//                                                     ____________________
//    =========================================       /___________________/|  <- 1
//                 1000 : 1 : 1                       |___________________|/
//                                                       1000 : 1000 : 1
namespace cairn::hard {
namespace {

/// Half the diagonal of a part of the solid, were it cut in `leaves` equal ones: a ball of that radius holds it and
/// reaches no farther than that from it.
double radiusOfEqualParts(const Vec3d& size, double leaves) {
  const bool isRod = size.y < size.x / 2;
  const double cells = isRod ? leaves : std::sqrt(leaves);
  const Vec3d part{size.x / cells, isRod ? size.y : size.y / cells, size.z};
  return length(part) / 2;
}

Outcome runRodsAndPlates(Effort effort) {
  FamilyDemands demands(effort, 120);
  Outcome outcome;
  const std::uint32_t depth = demands.options().depth;
  struct Solid {
    const char* name;
    Vec3d size;
    int cells;
  };
  for (const Solid& solid :
       {Solid{"rod", {1000, 1, 1}, 1}, {"plate", {1000, 1000, 1}, effort == Effort::quick ? 2 : 8}}) {
    const builder::TriangleMesh mesh = test::meshOf(test::cuboid(solid.size, solid.cells));
    const auto tree = demands.build(mesh);
    if (!tree) continue;
    double nodes = 1, leaves = 1;
    for (std::uint32_t level = 1; level <= depth; ++level) nodes += leaves *= 8;
    const double size = builder::boundsOf(mesh).diagonal();
    const std::string name = solid.name;
    outcome.measures.push_back({name + ": spheres", double(tree->nodeCount()), nodes, Bound::atMost, "", "", 0});
    outcome.measures.push_back({name + ": worst error of the leaves", 100 * double(tree->levelError(depth)) / size,
                                100 * 1.5 * radiusOfEqualParts(solid.size, leaves) / size, Bound::atMost, "% of size",
                                "", 0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase rodsAndPlates() {
  return {
      "G13", "rod 1000:1, plate 1000:1000:1",
      "covered everywhere, spheres within 8 to the level, the error stated (proposed list) and within one and a half "
      "times the radius of balls around as many equal parts",
      runRodsAndPlates};
}

}  // namespace cairn::hard
