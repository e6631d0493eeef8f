// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// How often each claim of an experiment holds over runs of several seeds, and the least, median and greatest of what
/// its rule holds against a limit, where that is one number. `documents`: of one experiment, one a seed, all with the
/// same claims; one at least.
nlohmann::ordered_json overSeeds(const std::vector<nlohmann::ordered_json>& documents);

/// One line for each claim.
std::string seedsText(const nlohmann::ordered_json& overSeeds);

}  // namespace cairn::accuracy_cost
