// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificate_cases.h"

namespace cairn::hard {

std::vector<HardCase> certificateCases() {
  return {singlePrecision(), randomPoses()};
}

}  // namespace cairn::hard
