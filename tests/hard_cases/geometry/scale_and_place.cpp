// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "builder_meshes.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "oracle/tree_difference.h"

// The same solid in micrometres, in megametres, and a million of its sizes away: single precision would leave it a
// handful of different coordinates.
//
//     o                                                             o
//     |<------------------- 1e6 diagonals --------------------------|
namespace cairn::hard {
namespace {

struct Move {
  const char* name;
  double scale, diagonals;
};

Outcome runScaleAndPlace(Effort effort) {
  FamilyDemands demands(effort, 120);
  const bool quick = effort == Effort::quick;
  Outcome outcome;
  for (const auto method : {builder::Method::combined, builder::Method::adaptive}) {
    builder::BuildOptions options = demands.options();
    options.method = method;
    const bool isAdaptive = method == builder::Method::adaptive;
    if (isAdaptive) {
      options.depth = 2;
      options.branching = quick ? 3 : 8;
    }
    const builder::TriangleMesh mesh = test::lumpyBall(!quick ? 6 : isAdaptive ? 2 : 3, 12);
    const double size = builder::boundsOf(mesh).diagonal();
    const auto base = demands.build(mesh, options);
    for (const Move& move : {Move{"1e-6 as large", 1e-6, 0}, {"1e6 as large", 1e6, 0}, {"1e6 sizes away", 1, 1e6}}) {
      const Vec3d shift = Vec3d(1, -1, 1) * (move.diagonals * size);
      const auto tree =
          demands.build(test::moved(mesh, [&](const Vec3d& v) { return v * move.scale + shift; }), options);
      if (!base || !tree) continue;
      const TreeDifference apart(*base, *tree, move.scale, shift);
      const std::string name = std::string(builder::methodName(method)) + ", " + move.name;
      outcome.measures.push_back(
          {name + ": balls differ by", apart.balls / size, 1e-4, Bound::atMost, "of size", "", 0});
      outcome.measures.push_back(
          {name + ": errors differ, beyond 1 %, by", apart.errors / size, 1e-4, Bound::atMost, "of size", "", 0});
    }
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase scaleAndPlace() {
  return {"G12", "scale 1e-6 and 1e6, 1e6 sizes from the origin",
          "the tree is the base tree scaled and shifted: centres and radii to 1e-4 of the size (proposed list), errors "
          "to the 1 % and 1e-4 of the size they are certified to",
          runScaleAndPlace};
}

}  // namespace cairn::hard
