// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "hard_case.h"

namespace cairn::hard {

/// The measures of a case that are known to miss when so much of it is run.
std::vector<std::string> knownMisses(const std::string& id, Effort effort);

/// Whether something has become worse: the measure misses and is not known to, or is beyond its limit by more than is
/// known, whatever Bullet's shapes do.
bool isNews(const std::string& id, const Measure& measure, Effort effort);

}  // namespace cairn::hard
