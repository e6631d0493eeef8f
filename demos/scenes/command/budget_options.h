// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/bullet/step.h"

namespace CLI {
class App;
}

namespace cairn::scenes {

/// Declares --budget-ops and --budget-us; negative amounts and NaN are wrong usage. `budget` must outlive the parsing.
void addBudgetOptions(CLI::App& app, bullet::StepBudget& budget);

}  // namespace cairn::scenes
