// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"

namespace cairn::accuracy_cost {

/// Columns of a table that say how well spheres fit: lengths as fractions of the bounding box's diagonal, volumes as
/// fractions of the solid's (see `builder::LevelFit`).
std::vector<std::string> withFitColumns(std::vector<std::string> columns);
/// The cells that belong to them, after others.
std::vector<std::string> withFit(std::vector<std::string> cells, const builder::LevelFit& fit);

}  // namespace cairn::accuracy_cost
