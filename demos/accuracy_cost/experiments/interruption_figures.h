// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "accuracy_cost/experiments/figure.h"
#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// Draws errors against operations. Then draws, for each model and reference tree, the thesis's five diagrams and the
/// true distances.
std::vector<Figure> drawInterruption(const Table& table);

}  // namespace cairn::accuracy_cost
