// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics_cases.h"

namespace cairn::hard {

std::vector<HardCase> dynamicsCases() {
  return {};
}

}  // namespace cairn::hard
