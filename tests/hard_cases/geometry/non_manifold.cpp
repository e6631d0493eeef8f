// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "cairn/builder/wrap.h"
#include "distance_oracle.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "mesh_texts.h"
#include "oracle/chain_of_balls.h"
#include "surface/mass_properties.h"

// An edge of four triangles, where two solids touch, and a vertex in the middle of an edge that does not know of it.
//
//      +-----+                         a-------------b
//     /     /|                         |\           /|
//    +-----+ +-----+                   |  \       /  |     above ab: one edge; below:
//    |     |/     /|  four triangles   c----`m'-----d      a-m and m-b
//    +-----+-----+ |  at this edge
//          |     | +
//          |     |/
//          +-----+
namespace cairn::hard {
namespace {

const char* const kTJunction =
    "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\nv 0 0 0.5\n"
    "f 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n"
    "f 1 9 4\nf 9 2 4\n";

/// Surface points of the original that are not inside the wrap, told by its winding number.
std::uint64_t outside(const builder::TriangleMesh& wrap, const builder::TriangleMesh& original, int points) {
  const test::DistanceOracle oracle{wrap};
  std::mt19937_64 engine(8);
  std::uint64_t count = 0;
  for (int i = 0; i < points; ++i)
    count += oracle.windingNumber(Vec3d(randomSurfacePoint(original, engine))) > 0.5 ? 0 : 1;
  return count;
}

Outcome runNonManifold(Effort effort) {
  const bool quick = effort == Effort::quick;
  FamilyDemands demands(effort, 60);
  const builder::TriangleMesh cube = test::meshOf(test::cuboid({1, 1, 1}, 1));
  const builder::TriangleMesh pair = test::joined(cube, test::moved(cube, [](const Vec3d& v) {
                                                    return v + Vec3d{1, 1, 0};
                                                  }));
  const std::string soup = test::stlText(pair);  // welded on import, the common edge too
  demands.refuses(demands.import("edge.stl", soup), "belongs to 4 triangles");
  const auto surface = demands.accepted(demands.importSurface("edge.stl", soup));

  Outcome outcome;
  const auto joined = surface ? demands.accepted(builder::repair(*surface)) : std::nullopt;
  if (joined) {
    demands.build(*joined);
    // A bead of the weld around the edge, square, on which two cubes of one lie: at most its whole section is new.
    const double weld = builder::RepairOptions{}.weld * builder::boundsOf(pair).diagonal();
    outcome.measures.push_back({"volume of both cubes after --repair, less 2",
                                std::abs(builder::signedVolume(*joined) - 2), 2 * weld * weld * (1 + 2 * weld),
                                Bound::atMost, "", "", 0});
  }
  builder::WrapOptions wide;
  wide.alpha = 0.1;
  wide.offset = 0.02;
  const auto wrapped = surface ? demands.accepted(builder::wrap(*surface, wide)) : std::nullopt;
  if (wrapped) {
    demands.build(wrapped->mesh);
    const int points = quick ? 500 : 20000;
    outcome.measures.push_back({"points of the original outside its wrap",
                                double(outside(wrapped->mesh, *surface, points)), 0, Bound::atMost,
                                "of " + std::to_string(points), "", 0});
  }
  demands.refuses(demands.import("junction.obj", kTJunction), "the mesh is open");
  const auto junction = demands.accepted(demands.importSurface("junction.obj", kTJunction));
  const auto mended = junction ? demands.accepted(builder::repair(*junction)) : std::nullopt;
  if (mended) {
    demands.build(*mended);
    outcome.measures.push_back({"volume of the cube after --repair, less 1",
                                std::abs(builder::signedVolume(*mended) - 1), 1e-12, Bound::atMost, "", "", 0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase nonManifold() {
  return {"G8", "an edge of four triangles, a T-junction",
          "refused with edge and count, or the open edge, named; --repair closes the junction and thickens the edge, "
          "--wrap makes a solid of it (proposed list) that holds every point of the original",
          runNonManifold};
}

}  // namespace cairn::hard
