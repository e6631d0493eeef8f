// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Compares the fit of whole trees by level and method (thesis 7.1.5).
Experiment levelsExperiment();

}  // namespace cairn::accuracy_cost
