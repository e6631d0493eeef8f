// SPDX-License-Identifier: GPL-3.0-or-later
// accuracy_cost repeats chapter 7 of the thesis from the command line.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <string>
#include <system_error>
#include <thread>

#include "accuracy_cost/runs/run.h"
#include "accuracy_cost/runs/seeds.h"
#include "cairn/core/atomic_file.h"
#include "options.h"
#include "scenes/command/program.h"

namespace cairn::accuracy_cost {
namespace {

/// Returns the command that repeats one experiment of a run.
std::string commandOf(const RunCommand& run, const Experiment& experiment) {
  std::string text = fmt::format("accuracy_cost run {} -o DIR --seed {}", experiment.name, run.settings.seed);
  if (run.settings.quick) text += " --quick";
  if (!run.models.folder.empty()) text += " --models MESHES";
  return text;
}

void printReport(const RunReport& report) {
  const auto& d = report.document;
  fmt::print("{} (thesis {}): {}{}\n  {}\n  {}\n", d["experiment"].get<std::string>(),
             d["thesis_section"].get<std::string>(), d["verdict"].get<std::string>(),
             report.measured ? fmt::format(", {:.0f} s", d["seconds"].get<double>()) : ", was there",
             d["we_found"].get<std::string>(), d["why"].get<std::string>());
  std::fflush(stdout);
}

/// One experiment with the command's own seed, into its own folder.
Result<RunReport> make(const RunCommand& command, const Experiment& experiment, const std::string& label) {
  std::error_code failure;
  std::filesystem::create_directories(command.folder, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", command.folder.string(), failure.message())};
  scenes::ProgressLine line(label);
  auto report = runExperiment(
      {&experiment, command.settings, command.models, command.folder, command.figures, commandOf(command, experiment)},
      line.callback());
  if (report && !report.value().leftOut.empty())
    fmt::print(stderr, "accuracy_cost: {}: without {}: {} is not there (package libcgal-demo).\n", experiment.name,
               fmt::join(report.value().leftOut, ", "), command.models.archive.string());
  return report;
}

/// Runs an experiment with every seed and adds its results to `all`.
Status makeWithSeeds(const RunCommand& command, const Experiment& experiment, const std::string& label,
                     nlohmann::ordered_json& all) {
  std::vector<nlohmann::ordered_json> documents;
  for (std::uint32_t i = 0; i < command.seeds; ++i) {
    RunCommand one = command;
    one.settings.seed += i;
    if (command.seeds > 1) one.folder /= fmt::format("seed-{}", one.settings.seed);
    const auto report = make(one, experiment, label);
    if (!report) return report.error();
    documents.push_back(report.value().document);
    if (!command.json) printReport(report.value());
  }
  for (const auto& document : documents) all.push_back(document);
  if (command.seeds == 1) return {};
  const auto together = overSeeds(documents);
  if (!command.json) fmt::print("{}", seedsText(together));
  return writeFileAtomically(command.folder / fmt::format("{}-seeds.json", experiment.name), together.dump(1) + "\n");
}

Status execute(const RunCommand& command) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  command.threads == 0 ? cores : command.threads);
  auto all = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < command.experiments.size(); ++i) {
    const Experiment& experiment = *command.experiments[i];
    const std::string label = fmt::format("[{}/{}] {}", i + 1, command.experiments.size(), experiment.name);
    if (Status made = makeWithSeeds(command, experiment, label, all); !made) return made;
  }
  if (command.json) fmt::print("{}\n", all.dump(1));
  return {};
}

Status execute(const ModelsCommand& command) {
  scenes::ProgressLine line("models");
  for (const std::string& name : command.names) {
    const auto file = makeModel(name, command.models, line.callback());
    if (!file) return file.error();
    fmt::print("{}\n", file.value().string());
  }
  return {};
}

Status execute(const ListCommand&) {
  for (const Experiment& e : allExperiments()) fmt::print("{:<18} {} (thesis {})\n", e.name, e.title, e.section);
  return {};
}

}  // namespace
}  // namespace cairn::accuracy_cost

int main(int argc, char** argv) try {
  using namespace cairn;
  const auto parsed = accuracy_cost::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const Status status = std::visit([](const auto& command) { return accuracy_cost::execute(command); },
                                   std::get<accuracy_cost::Command>(parsed));
  return status ? scenes::kExitDone : scenes::refuse("accuracy_cost", status.error());
} catch (const std::exception& e) {
  return cairn::scenes::refuse("accuracy_cost", {fmt::format("stopped by an unexpected failure ({})", e.what())});
}
