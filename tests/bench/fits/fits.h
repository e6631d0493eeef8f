// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fit_world.h"

namespace cairn::bench {

/// How one scene of pieces that fit went.
struct FitResult {
  std::string name;
  bool holds = false;
  std::string figures;  ///< what was measured, with units
};

struct Fit {
  const char* name;
  FitResult (*run)(Pieces& pieces, FitShape shape);
};

/// All scenes, in the order of the table.
std::vector<Fit> fits();

}  // namespace cairn::bench
