// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Compares max-cover with max-elim in the Expand reduction (thesis 7.1.3).
Experiment expandSelectionExperiment();

}  // namespace cairn::accuracy_cost
