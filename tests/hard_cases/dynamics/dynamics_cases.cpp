// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics_cases.h"

namespace cairn::hard {

std::vector<HardCase> dynamicsCases() {
  return {restForAMinute(),  stackOfTen(),      builtToStand(),  massRatio(),     deepOverlap(),
          wallShots(),       thinRods(),        tumbling(),      fastSpin(),      flatMeshes(),
          ballPit(),         heapComesToRest(), smallAndLarge(), farFromOrigin(), sphereCountIndependence(),
          budgetStarvation()};
}

}  // namespace cairn::hard
