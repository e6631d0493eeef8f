// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// A pair of cells of the thesis's tables 7.2 to 7.5: the factor by which the second construction's error is smaller.
struct ThesisRatio {
  std::string table, model, first, second;
  unsigned level = 0;
  double max = 0, rms = 0;  ///< over the spheres of the level
};

/// All ratios of tests/tables/thesis.tsv, compiled in.
const std::vector<ThesisRatio>& thesisRatios();

}  // namespace cairn::accuracy_cost
