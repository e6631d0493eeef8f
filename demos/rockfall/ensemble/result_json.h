// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/document.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

Json resultToJson(const RunResult& result);
Json costToJson(const RunCost& cost);

/// Precondition: made by the functions above; throws `Json::exception` where it was not.
RunResult resultFromJson(const Json& json);
RunCost costFromJson(const Json& json);

}  // namespace cairn::rockfall
