// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/command/budget_options.h"

#include <CLI/CLI.hpp>
#include <string>

#include "scenes/command/program.h"

namespace cairn::scenes {

void addBudgetOptions(CLI::App& app, bullet::StepBudget& budget) {
  app.add_option("--budget-ops", budget.operations, "narrow-phase operations a step (default: no limit)")
      ->check(refuseNoWholeNumber);
  // CLI11's own range lets NaN through: it compares false with both ends.
  const auto refuseNan = [](const std::string& text) {
    double value = 0;
    const bool isNumber = CLI::detail::lexical_cast(text, value) && value >= 0;
    return isNumber ? std::string() : "'" + text + "' is not a number of microseconds, 0 or more";
  };
  app.add_option("--budget-us", budget.microseconds, "narrow-phase microseconds a step (default: no limit)")
      ->check(refuseNan);
}

}  // namespace cairn::scenes
