// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/figure.h"
#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// Whether gnuplot can be run: what to ask before hours of measuring for a figure.
Status checkGnuplot();

/// Draws `folder`/NAME.svg and .png from the CSV file of `table`, each whole or not at all. The files' names. Fails
/// when gnuplot is missing or refuses.
Result<std::vector<std::string>> drawFigure(const Figure& figure, const Table& table, const std::filesystem::path& csv,
                                            const std::filesystem::path& folder);

}  // namespace cairn::accuracy_cost
