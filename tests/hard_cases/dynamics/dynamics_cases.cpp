// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics_cases.h"

namespace cairn::hard {

std::vector<HardCase> dynamicsCases() {
  return {restForAMinute(),          stackOfTen(),      massRatio(), deepOverlap(), wallShots(),
          sphereCountIndependence(), budgetStarvation()};
}

}  // namespace cairn::hard
