// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry_cases.h"

namespace cairn::hard {

std::vector<HardCase> geometryCases() {
  return {cosphericalPoints(), onOneSphere(), duplicateVertices(), slivers(),        flatSolids(),  tooLittle(),
          openMeshes(),        nonManifold(), crossingAndNested(), flippedWinding(), brokenFiles(), scaleAndPlace(),
          rodsAndPlates(),     gaps(),        largeAndStarved()};
}

}  // namespace cairn::hard
