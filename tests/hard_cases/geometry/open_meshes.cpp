// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "surface/mass_properties.h"

// One triangle is missing: what is inside is a matter of opinion, and a depth means nothing.
//
//       /'.''/'.    /'.'/
//      /  '.'  '. /   '.      the hole has three edges
//      '.  /'----'/'.  /
//        '/  '. /   './
namespace cairn::hard {
namespace {

Outcome runOpenMeshes(Effort effort) {
  FamilyDemands demands(effort, 60);
  const builder::TriangleMesh whole =
      test::moved(test::lumpyBall(effort == Effort::quick ? 3 : 10, 7), [](const Vec3d& v) { return Vec3d(Vec3(v)); });
  const double volume = builder::signedVolume(whole);
  int tried = 0, unfilled = 0;
  double worst = 0;
  std::mt19937_64 engine(7);
  for (int round = 0; round < (effort == Effort::quick ? 3 : 12); ++round) {
    builder::TriangleMesh open = whole;
    open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(engine() % open.triangles.size()));
    demands.refuses(demands.import("open.obj", test::objText(open)), "the mesh is open: the edge (");
    demands.refuses(builder::buildTree(open, demands.options()), "the mesh is open: the edge (");
    const auto surface = demands.accepted(demands.importSurface("open.obj", test::objText(open)));
    builder::RepairCounts counts;
    const auto mended = surface ? demands.accepted(builder::repair(*surface, &counts)) : std::nullopt;
    ++tried;
    if (!mended || counts.filledHoles != 1 || counts.addedTriangles != 1) ++unfilled;
    if (!mended) continue;
    worst = std::max(worst, std::abs(builder::signedVolume(*mended) / volume - 1));
    if (round == 0) demands.build(*mended);
  }
  Outcome outcome{{{"holes not filled with the triangle that was missing", double(unfilled), 0, Bound::atMost,
                    "of " + std::to_string(tried), "", 0},
                   {"volume after --repair against the whole solid's", worst, 1e-12, Bound::atMost, "relative", "", 0}},
                  ""};
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase openMeshes() {
  return {
      "G7", "one triangle missing",
      "refused, with the edge named; --repair fills the hole, says so (proposed list) and gives the solid back, its "
      "volume to the rounding of the sum",
      runOpenMeshes};
}

}  // namespace cairn::hard
