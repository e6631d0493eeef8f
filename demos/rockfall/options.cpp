// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <CLI/CLI.hpp>

#include "scenes/command/budget_options.h"
#include "scenes/command/program.h"

namespace cairn::rockfall {

std::variant<Options, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(
      "Lets generated concave rocks fall down a stepped slope, without a window, and writes their trajectories as "
      "CSV.\n"
      "A table says each second what the narrow phase cost and how much of its budget it used. The same options and "
      "seed give the "
      "same trajectories, unless time is the budget. A step is 1/120 s.",
      "rockfall");
  Options options;
  app.add_option("--rocks", options.scene.rocks, "how many")->check(CLI::Range(1U, 10000U))->capture_default_str();
  app.add_option("--distinct", options.distinctRocks, "different rock shapes among them, each built once")
      ->check(CLI::Range(1U, 100U))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "simulated time")->check(CLI::Range(1U, 3600U))->capture_default_str();
  scenes::addBudgetOptions(app, options.scene.budget);
  app.add_option("--seed", options.scene.seed, "of slope, rocks and release")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_option("-o,--output", options.folder, "folder for trajectories.csv; made if missing")->capture_default_str();
  app.add_option("--json", options.json, "write a summary to this file");
  app.footer("Example: rockfall --rocks 200 --seconds 30 --budget-ops 40000 -o run1 --json run1.json");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  return options;
}

}  // namespace cairn::rockfall
