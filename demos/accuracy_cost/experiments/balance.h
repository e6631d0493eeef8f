// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Compares the number of spheres that the optimiser drops with the error this costs (thesis 6.3 and 7.1.5).
Experiment balanceExperiment();

}  // namespace cairn::accuracy_cost
