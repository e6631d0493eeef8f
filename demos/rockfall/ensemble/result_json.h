// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/document.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

Json resultToJson(const RunResult& result);
Json costToJson(const RunCost& cost);

/// Precondition: the functions above made `json`; throws `Json::exception` otherwise.
RunResult resultFromJson(const Json& json);
RunCost costFromJson(const Json& json);

}  // namespace cairn::rockfall
