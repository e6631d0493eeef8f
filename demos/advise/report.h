// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "advise/measure.h"

namespace cairn::advise {

/// What was asked for and what came of it.
struct Advice {
  std::string mesh;
  Trial trial;
  double budgetUs = 0;
  Measured measured;
};

/// Of each tree the best budget within the time, or with `all` every budget; the chosen one is marked.
std::string tableText(const Advice& advice, bool all);

/// The error of the chosen tree against its time, budget by budget, in letters.
std::string curveText(const Advice& advice);

/// Everything, units in the keys.
nlohmann::ordered_json toJson(const Advice& advice);

/// Draws the error of the best trees against time, as `svg` and as a PNG beside it. Fails when gnuplot is missing or
/// refuses.
Status drawCurves(const Advice& advice, const std::filesystem::path& svg);

}  // namespace cairn::advise
