// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// A cell pair of the thesis's tables 7.2 to 7.5: how many times smaller the second construction's error is.
struct ThesisRatio {
  std::string table, model, first, second;
  unsigned level = 0;
  double max = 0, rms = 0;  ///< over the spheres of the level
};

/// All of tests/tables/thesis.tsv, compiled in.
const std::vector<ThesisRatio>& thesisRatios();

}  // namespace cairn::accuracy_cost
