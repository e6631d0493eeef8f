// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "accuracy_cost/experiments/figure.h"

namespace cairn::accuracy_cost {

enum class PictureFormat { svg, png };

/// Returns a gnuplot program (5.4 or later) that draws a figure from the CSV file of `table` into `output`. Colours
/// follow Okabe and Ito (2008), which colour-blind readers can distinguish, with different markers and dashes. One key
/// stands below all panels. A logarithmic axis has base 10 where the data span more than a factor of 100, else base 2.
/// Below a factor of 6 the axis is linear, so that it has labels.
std::string gnuplotScript(const Figure& figure, const Table& table, const std::filesystem::path& csv,
                          PictureFormat format, const std::filesystem::path& output);

}  // namespace cairn::accuracy_cost
