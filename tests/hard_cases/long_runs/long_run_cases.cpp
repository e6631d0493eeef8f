// SPDX-License-Identifier: GPL-3.0-or-later
#include "long_run_cases.h"

namespace cairn::hard {

std::vector<HardCase> longRunCases() {
  return {tenMinutesAtRest(), anHourOfBlows()};
}

}  // namespace cairn::hard
