// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.h"

namespace cairn::hard {

std::vector<HardCase> allHardCases() {
  std::vector<HardCase> all = geometryCases();
  for (const std::vector<HardCase>& family : {dynamicsCases(), certificateCases()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

}  // namespace cairn::hard
