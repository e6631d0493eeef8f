// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// The scans that the thesis names in its conclusions ("for bunny and dragon").
extern const std::vector<std::string> kNamedScans;

/// The named scans that a table has, and those that it lacks.
struct Scans {
  std::vector<std::string> measured, lacking;
};
Scans scansOf(const Table& table);

}  // namespace cairn::accuracy_cost
