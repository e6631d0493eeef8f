// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Measures trees in collision detection that is interrupted (thesis 7.2).
Experiment interruptionExperiment();

}  // namespace cairn::accuracy_cost
