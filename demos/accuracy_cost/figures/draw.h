// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/figure.h"
#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// Fails when gnuplot cannot be run. Callers ask before they measure for hours.
Status checkGnuplot();

/// Draws `folder`/NAME.svg and .png from the CSV file of `table`, each completely or not at all. Returns the files'
/// names. Fails when gnuplot is missing or reports an error.
Result<std::vector<std::string>> drawFigure(const Figure& figure, const Table& table, const std::filesystem::path& csv,
                                            const std::filesystem::path& folder);

}  // namespace cairn::accuracy_cost
