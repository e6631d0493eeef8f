// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "accuracy_cost/experiments/claim.h"
#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// Adds claims that the error of one tree falls with its budget, by operations and by time. Also names the dominated
/// settings: another of our settings has a smaller error in less time. Adds nothing where no tree has two budgets.
void addBudgets(const Table& table, std::vector<Claim>& claims);

}  // namespace cairn::accuracy_cost
