// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "scenes/figures/spread.h"
#include "scenes/heap/heap_run.h"

namespace cairn::scenes {

/// Returns the measured keys of frame_budget's JSON. Keys that only the sphere-tree can fill (operations, certified
/// error, unresolved pairs) are null for other shapes, never left out.
nlohmann::ordered_json toJson(const RunCost& cost);
nlohmann::ordered_json toJson(const HeapReport& report);

nlohmann::ordered_json toJson(const Spread& spread);

}  // namespace cairn::scenes
