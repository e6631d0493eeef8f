// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/bullet/step.h"

namespace CLI {
class App;
}

namespace cairn::scenes {

/// For `CLI::Option::check`: one sentence if the text is no whole number from 0 to 2^63 - 1, else empty.
std::string refuseNoWholeNumber(const std::string& text);

/// Declares --budget-ops and --budget-us; negative amounts and NaN are wrong usage. `budget` must outlive the parsing.
void addBudgetOptions(CLI::App& app, bullet::StepBudget& budget);

}  // namespace cairn::scenes
