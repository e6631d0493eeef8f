// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace cairn::scenes {

/// Nearest-rank quantiles of a sample: the smallest value such that at least this share of the sample is no larger.
struct Quantiles {
  double median = 0, p99 = 0, p999 = 0, p9999 = 0, max = 0;
};

/// All zero for an empty sample. Sorts: n log n.
Quantiles quantilesOf(std::vector<double> sample);

}  // namespace cairn::scenes
