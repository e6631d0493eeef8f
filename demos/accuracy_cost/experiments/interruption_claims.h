// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "accuracy_cost/experiments/claim.h"
#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// Judges the thesis's conclusions of 7.2 and 8.1 about interrupted collision detection, for the trees in the table.
std::vector<Claim> judgeInterruption(const Table& table);

}  // namespace cairn::accuracy_cost
