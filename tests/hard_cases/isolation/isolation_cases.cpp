// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolation_cases.h"

namespace cairn::hard {

std::vector<HardCase> isolationCases() {
  return {brokenBody(), sameBits()};
}

}  // namespace cairn::hard
