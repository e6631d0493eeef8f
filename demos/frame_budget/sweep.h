// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "options.h"

namespace cairn::frame_budget {

/// Measures combinations one after the other. Prints a line for each as it ends, and writes it to --csv and --json.
/// Combinations of `converge` with the same poses run together. Fails as any combination does, and with
/// `builder::kCancelled` when the user stops it; finished combinations are written. Precondition: each has one shape;
/// combinations of one scene and one number of bodies are adjacent.
Status measureSweep(const std::vector<Options>& combinations);

}  // namespace cairn::frame_budget
