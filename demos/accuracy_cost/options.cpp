// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "scenes/command/program.h"

namespace cairn::accuracy_cost {
namespace {

constexpr const char* kDescription =
    "What accuracy costs: repeats the experiments of chapter 7 of Bradshaw's thesis. For each it writes a table, "
    "figures, and what was found beside what the thesis says. An experiment that is there already, of the same "
    "settings, "
    "is not repeated: a run that was cancelled goes on.";

constexpr const char* kExamples =
    "Examples:\n"
    "  accuracy_cost list\n"
    "  accuracy_cost run all --quick -o out/accuracy\n"
    "  accuracy_cost run sampling --models my/meshes -o out/accuracy\n"
    "  accuracy_cost run levels --quick --seeds 4 -o out/seeds";

struct Texts {
  std::string experiment, seed = "1";
};

std::string refuseUnknown(const std::string& name) {
  if (name == "all" || findExperiment(name) != nullptr) return {};
  std::vector<const char*> names;
  for (const Experiment& e : allExperiments()) names.push_back(e.name);
  return fmt::format("there is no experiment '{}'; choose all or one of {}", name, fmt::join(names, ", "));
}

CLI::App* addRun(CLI::App& app, RunCommand& run, Texts& texts) {
  CLI::App* command = app.add_subcommand("run", "make an experiment, or all of them");
  command->add_option("EXPERIMENT", texts.experiment, "its name, or all")->required()->check(refuseUnknown);
  command->add_option("-o,--output", run.folder, "folder for what is made, itself made if missing")->required();
  command->add_option("--models", run.models.folder, "folder of meshes to be used instead of the thesis's");
  command->add_option("--archive", run.models.archive, "archive of meshes (libcgal-demo)")->capture_default_str();
  command->add_flag("--quick", run.settings.quick, "few models and coarse steps: minutes instead of hours");
  command->add_option("--seed", texts.seed, "of whatever is random")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  command
      ->add_option("--seeds", run.seeds,
                   "make it with so many seeds, counted on from --seed, each in a folder of its own, and tell for "
                   "how many each claim holds (EXPERIMENT-seeds.json)")
      ->check(CLI::Range(1U, 100U));
  command->add_option("--threads", run.threads, "0: one per core; tables do not depend on it")
      ->check(CLI::Range(0U, 1024U));
  command->add_flag("!--no-figures", run.figures, "draw nothing (gnuplot is not needed then)");
  command->add_flag("--json", run.json, "print what was found as JSON, one array");
  return command;
}

CLI::App* addModels(CLI::App& app, ModelsCommand& models) {
  CLI::App* command = app.add_subcommand("models", "make the meshes experiments use, print their files");
  command->add_option("NAME", models.names, "which; default: all");
  command->add_option("-o,--output", models.models.made, "folder for them, made if missing")->required();
  command->add_option("--archive", models.models.archive, "archive of meshes (libcgal-demo)")->capture_default_str();
  return command;
}

}  // namespace

std::variant<Command, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(kDescription, "accuracy_cost");
  app.footer(kExamples);
  app.require_subcommand(1);
  RunCommand run;
  ModelsCommand models;
  Texts texts;
  const CLI::App* runs = addRun(app, run, texts);
  const CLI::App* makesModels = addModels(app, models);
  app.add_subcommand("list", "name the experiments and what they repeat");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  if (*runs) {
    run.settings.seed = std::stoull(texts.seed);
    run.models.made = run.folder / "models";
    for (const Experiment& e : allExperiments())
      if (texts.experiment == "all" || texts.experiment == e.name) run.experiments.push_back(&e);
    return Command(run);
  }
  if (*makesModels) {
    if (models.names.empty()) models.names = modelNames();
    return Command(models);
  }
  return Command(ListCommand{});
}

}  // namespace cairn::accuracy_cost
