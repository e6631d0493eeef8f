// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "options.h"

namespace cairn::frame_budget {

/// Measures combinations one after the other and prints, and writes to --csv and --json, a line for each as it is done;
/// those of `converge` that share their poses are done together. Fails for what one of them refuses, and with
/// `builder::kCancelled` when the user stops it; what is done by then is written. Precondition: each has one shape, and
/// combinations of one scene and one number of bodies follow each other.
Status measureSweep(const std::vector<Options>& combinations);

}  // namespace cairn::frame_budget
