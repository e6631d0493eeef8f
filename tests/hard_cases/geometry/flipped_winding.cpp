// SPDX-License-Identifier: GPL-3.0-or-later
#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "surface/mass_properties.h"

// Normals that point the wrong way: a stone whose inside is all the world but the stone, or one face of it so.
//
//        ^   ^                      |   ^
//      +-|---|-+                  +-v---|-+
//    <-|       |->    whole:    ->|       |->   one face:
//      +-|---|-+      inwards     +-|---|-+     a contradiction at its edges
//        v   v                      v   v
namespace cairn::hard {
namespace {

Outcome runFlippedWinding(Effort effort) {
  FamilyDemands demands(effort, 60);
  const builder::TriangleMesh right =
      test::moved(test::lumpyBall(effort == Effort::quick ? 2 : 10, 10), [](const Vec3d& v) { return Vec3d(Vec3(v)); });
  const double volume = builder::signedVolume(right);
  builder::TriangleMesh oneFace = right;
  std::swap(oneFace.triangles[17][1], oneFace.triangles[17][2]);
  const builder::TriangleMesh whole = test::flipped(right);

  Outcome outcome;
  const auto mend = [&](const builder::TriangleMesh& mesh, const char* named, std::size_t turned, const char* name) {
    demands.refuses(demands.import("turned.obj", test::objText(mesh)), named);
    demands.refuses(builder::buildTree(mesh, demands.options()), named);
    const auto surface = demands.accepted(demands.importSurface("turned.obj", test::objText(mesh)));
    builder::RepairCounts counts;
    const auto mended = surface ? demands.accepted(builder::repair(*surface, &counts)) : std::nullopt;
    if (!mended) return;
    demands.build(*mended);
    const double missed = std::abs(double(counts.turnedTriangles) - double(turned));
    outcome.measures.push_back(
        {std::string(name) + ": triangles not turned, or needlessly", missed, 0, Bound::atMost, "", "", 0});
    outcome.measures.push_back({std::string(name) + ": volume after --repair against the right one",
                                std::abs(builder::signedVolume(*mended) / volume - 1), 1e-12, Bound::atMost, "relative",
                                "", 0});
  };
  mend(whole, "inside out", whole.triangles.size(), "whole mesh");
  mend(oneFace, "face opposite sides at their common edge", 1, "one face");
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase flippedWinding() {
  return {"G10", "flipped winding, whole and one face",
          "refused by name; --repair turns just these triangles and gives the right volume with the right sign "
          "(proposed list), to the rounding of the sum",
          runFlippedWinding};
}

}  // namespace cairn::hard
