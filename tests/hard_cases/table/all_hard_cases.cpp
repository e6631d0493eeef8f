// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.h"

namespace cairn::hard {

std::vector<HardCase> allHardCases() {
  std::vector<HardCase> all = geometryCases();
  const std::vector<HardCase> dynamics = dynamicsCases();
  all.insert(all.end(), dynamics.begin(), dynamics.end());
  return all;
}

}  // namespace cairn::hard
