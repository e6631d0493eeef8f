// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Measures reductions of 500 medial spheres to 8 to 200 (thesis 7.1.4).
Experiment reductionsExperiment();

}  // namespace cairn::accuracy_cost
