// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "accuracy_cost/experiments/claim.h"
#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// Returns the claims of `error-against-time`. `found` of each claim names the exceptions.
std::vector<Claim> judgeErrorAgainstTime(const Table& table);

}  // namespace cairn::accuracy_cost
