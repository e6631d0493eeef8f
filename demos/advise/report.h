// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "advise/measure.h"

namespace cairn::advise {

/// The request and its result.
struct Advice {
  std::string mesh;
  Trial trial;
  double budgetUs = 0;
  Measured measured;
};

/// Returns a table of the best budget within the time for each tree; with `all`, of every budget. The chosen row is
/// marked.
std::string tableText(const Advice& advice, bool all);

/// Returns a text diagram: the error of the chosen tree against its time, budget by budget.
std::string curveText(const Advice& advice);

/// Returns all results, with units in the keys.
nlohmann::ordered_json toJson(const Advice& advice);

/// Draws the error of the best trees against time, as `svg` and as a PNG beside it. Fails when gnuplot is missing or
/// reports an error.
Status drawCurves(const Advice& advice, const std::filesystem::path& svg);

}  // namespace cairn::advise
