// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.h"

namespace cairn::hard {

std::vector<HardCase> allHardCases() {
  std::vector<HardCase> all = geometryCases();
  for (const auto& more : {dynamicsCases(), certificateCases(), isolationCases(), longRunCases()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace cairn::hard
