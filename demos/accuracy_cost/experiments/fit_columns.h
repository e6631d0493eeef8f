// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"

namespace cairn::accuracy_cost {

/// Appends the table columns for the fit of spheres. Lengths are fractions of the bounding box's diagonal, volumes
/// fractions of the solid's (see `builder::LevelFit`).
std::vector<std::string> withFitColumns(std::vector<std::string> columns);
/// Appends the cells of these columns.
std::vector<std::string> withFit(std::vector<std::string> cells, const builder::LevelFit& fit);

}  // namespace cairn::accuracy_cost
