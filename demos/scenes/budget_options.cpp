// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/budget_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>

namespace cairn::scenes {

std::string refuseNoWholeNumber(const std::string& text) {
  // CLI11's own conversion takes 0x10, and what is too large for the largest number.
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size() && value >= 0;
  return isNumber ? std::string() : "'" + text + "' is not a whole number, 0 or more";
}

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
