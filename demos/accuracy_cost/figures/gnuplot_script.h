// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "accuracy_cost/experiments/figure.h"

namespace cairn::accuracy_cost {

enum class PictureFormat { svg, png };

/// A gnuplot program (5.4 or later) that draws a figure from the CSV file of `table` into `output`: colours after Okabe
/// and Ito (2008), which the colour-blind tell apart, with different markers and dashes; one key below all panels. A
/// logarithmic axis is of base 10 where the data span more than a factor of 100, of base 2 where less, and linear below
/// a factor of 6, so that it has labels.
std::string gnuplotScript(const Figure& figure, const Table& table, const std::filesystem::path& csv,
                          PictureFormat format, const std::filesystem::path& output);

}  // namespace cairn::accuracy_cost
