// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry_cases.h"

namespace cairn::hard {

std::vector<HardCase> geometryCases() {
  return {onOneSphere()};
}

}  // namespace cairn::hard
