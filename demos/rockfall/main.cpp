// SPDX-License-Identifier: GPL-3.0-or-later
// rockfall simulates rocks on a slope from a case file, in ensembles, without a window.
#include <fmt/core.h>

#include <unistd.h>
#include <cstdio>
#include <string>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "explain_report.h"
#include "options.h"
#include "rockfall/convergence/convergence_report.h"
#include "rockfall/ensemble/run_folder.h"
#include "rockfall/outputs/merge_outputs.h"
#include "rockfall/simulation/run_effects.h"
#include "scenes/command/program.h"
#include "validate_command.h"

namespace cairn::rockfall {
namespace {

/// Puts the case file's name before an error sentence that begins with a path in the case.
Error inCase(const std::filesystem::path& file, const Error& error) {
  for (const char* section : {"/terrain", "/step_s", "/budget/", "/rocks/", "/effects/", "/collectors/", "/outputs/"})
    if (error.message.starts_with(section)) return Error{fmt::format("{}: {}", file.string(), error.message)};
  return error;
}

Result<Scene> prepare(const std::filesystem::path& caseFile, const std::optional<std::filesystem::path>& cacheFolder,
                      Case description) {
  TreeCache cache(cacheFolder ? cacheFolder : TreeCache::defaultFolder());
  scenes::ProgressLine progress("building trees of rocks");
  auto scene = prepareScene(std::move(description), cache, progress.callback());
  if (cache.complaint()) fmt::print(stderr, "rockfall: trees are not kept: {}.\n", cache.complaint()->message);
  if (!scene) return inCase(caseFile, scene.error());
  return scene;
}

Result<Json> documentOf(const std::filesystem::path& file) {
  const auto content = readFile(file);
  if (!content) return content.error();
  return parseDocument({reinterpret_cast<const char*>(content.value().data()), content.value().size()}, file.string());
}

Status execute(const RunCommand& command) {
  auto description = readCase(command.caseFile);
  if (!description) return description.error();
  const auto document = documentOf(command.caseFile);
  if (!document) return document.error();
  const auto scene = prepare(command.caseFile, command.cache, std::move(description).value());
  if (!scene) return scene.error();
  scenes::ProgressLine progress("runs");
  const auto keepGoing = [&, own = getpid()](std::uint64_t done, std::uint64_t all) {
    if (command.jobs > 1 || own != getpid()) return !scenes::interrupted();
    return progress.show("done", static_cast<double>(done) / static_cast<double>(all));
  };
  const auto report = computeRuns(scene.value(), document.value(),
                                  {command.runs, command.folder, command.jobs, command.whole}, keepGoing);
  if (!report) return inCase(command.caseFile, report.error());
  fmt::print("runs {}:{} of {} in {}: {} computed, {} were there\n", command.runs.first, command.runs.last,
             scene.value().description.name, command.folder.string(), report.value().computed, report.value().kept);
  return {};
}

Status execute(const ExplainCommand& command) {
  if (command.json)
    if (Status writable = checkWritable(*command.json); !writable) return writable;
  auto description = readCase(command.caseFile);
  if (!description) return description.error();
  const auto scene = prepare(command.caseFile, command.cache, std::move(description).value());
  if (!scene) return scene.error();
  const Explanation explanation = explain(scene.value());
  fmt::print("{}", explainText(scene.value(), explanation));
  return command.json ? writeFileAtomically(*command.json, explainJson(scene.value(), explanation)) : Status();
}

Status execute(const MergeCommand& command) {
  const auto report = mergeOutputs({command.parts, command.folder, command.png, command.geopackage, command.geojson});
  if (!report) return report.error();
  const MergeReport& merged = report.value();
  fmt::print("{} runs, {} rocks, {} lost, {:.1f} s of CPU time; results in {}\n", merged.runs, merged.rocks,
             merged.lost, merged.cpuS, command.folder.string());
  fmt::print("{}", missingText(merged.missing, merged.runs));
  for (std::size_t i = 0; i < merged.effects.size(); ++i)
    fmt::print("  effect {:<22} acted {:>12} times, {:.3f} s, took {:.6g} kJ\n", merged.effects[i].name,
               merged.effects[i].acted, merged.effects[i].elapsedUs / 1e6, merged.did[i].energyTakenJ / 1e3);
  fmt::print("{}{}", enoughText(merged.quantiles, merged.runs), enoughText(merged.cells));
  fmt::print("merged hash {}\n", merged.hash);
  return {};
}

Status execute(const ConvergeCommand& command) {
  if (command.json)
    if (Status writable = checkWritable(*command.json); !writable) return writable;
  auto description = readCase(command.caseFile);
  if (!description) return description.error();
  if (const Status checked = checkConvergence(description.value(), command.options); !checked)
    return inCase(command.caseFile, checked.error());
  auto scene = prepare(command.caseFile, command.cache, std::move(description).value());
  if (!scene) return scene.error();
  scenes::ProgressLine progress("runs");
  const auto found = converge(scene.value(), command.options, [&](double done) { return progress.show("done", done); });
  if (!found) return inCase(command.caseFile, found.error());
  const Case& read = scene.value().description;
  fmt::print("{}", convergenceText(found.value(), read, command.options.tolerance));
  if (!command.json) return {};
  return writeFileAtomically(*command.json, convergenceJson(found.value(), read, command.options.tolerance));
}

Status execute(const ValidateCommand& command) {
  return validate(command);
}

Status execute(const SchemaCommand&) {
  std::fwrite(caseSchema().data(), 1, caseSchema().size(), stdout);
  return {};
}

}  // namespace
}  // namespace cairn::rockfall

int main(int argc, char** argv) try {
  using namespace cairn;
  const auto parsed = rockfall::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const Status status =
      std::visit([](const auto& command) { return rockfall::execute(command); }, std::get<rockfall::Command>(parsed));
  return status ? scenes::kExitDone : scenes::refuse("rockfall", status.error());
} catch (const std::exception& e) {
  return cairn::scenes::refuse("rockfall", {fmt::format("stopped by an unexpected failure ({})", e.what())});
}
