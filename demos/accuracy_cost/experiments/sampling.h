// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// Compares regular with adaptive sampling of the medial axis (thesis 7.1.2).
Experiment samplingExperiment();

}  // namespace cairn::accuracy_cost
