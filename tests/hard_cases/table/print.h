// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hard_case.h"

namespace cairn::hard {

/// The lines of a case in the table: a heading with the verdict, a line for each measure, the reason where there is
/// one.
std::string linesOf(const HardCase& hardCase, const Outcome& outcome, double seconds);

/// {"id", "name", "criterion", "measured", "stock", "verdict", "why", "seconds", "measures": [...]}; `measured` and
/// `stock` in words.
nlohmann::ordered_json jsonOf(const HardCase& hardCase, const Outcome& outcome, double seconds);

}  // namespace cairn::hard
