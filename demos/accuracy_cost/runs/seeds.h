// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// Counts how often each claim of an experiment holds over runs with several seeds. Where the rule has a single figure,
/// also gives its least, median and greatest value. Precondition: `documents` holds one document for each seed, at
/// least one, all of one experiment and with the same claims.
nlohmann::ordered_json overSeeds(const std::vector<nlohmann::ordered_json>& documents);

/// Returns one line for each claim.
std::string seedsText(const nlohmann::ordered_json& overSeeds);

}  // namespace cairn::accuracy_cost
