// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// The scans the thesis draws conclusions from by name, "for bunny and dragon".
extern const std::vector<std::string> kNamedScans;

/// Those of them a table has, and those it lacks.
struct Scans {
  std::vector<std::string> measured, lacking;
};
Scans scansOf(const Table& table);

}  // namespace cairn::accuracy_cost
