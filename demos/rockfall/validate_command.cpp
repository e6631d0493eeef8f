// SPDX-License-Identifier: GPL-3.0-or-later
#include "validate_command.h"

#include <fmt/core.h>

#include <string>
#include <utility>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "rockfall/validation/report.h"
#include "scenes/command/program.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;

Result<QuarryScene> prepare(const ValidateCommand& command, const ValidationSettings& settings) {
  TreeCache cache(command.cache ? command.cache : TreeCache::defaultFolder());
  scenes::ProgressLine progress("building trees of blocks");
  auto quarry = prepareQuarry(command.folder, settings, cache, progress.callback());
  if (cache.complaint()) fmt::print(stderr, "rockfall: trees are not kept: {}.\n", cache.complaint()->message);
  return quarry;
}

Result<ValidationSettings> calibrated(const ValidateCommand& command, QuarryScene& quarry,
                                      const ValidationSettings& settings) {
  scenes::ProgressLine progress("calibrating on P1");
  const auto found =
      calibrate(quarry, settings, command.jobs, [&](double done) { return progress.show("done", done); });
  if (!found) return found.error();
  const auto text = calibratedSettings(found.value(), settings);
  if (!text) return text.error();
  if (const Status written = writeFileAtomically(*command.calibrated, text.value()); !written) return written.error();
  fmt::print("{}\n", calibrationText(found.value(), settings));
  return readSettings(*command.calibrated);
}

/// Each place of each block begins with another orientation, or few of them would fall.
std::vector<BlockRun> everyNth(const std::vector<BlockRun>& runs, std::uint32_t n) {
  std::vector<BlockRun> some;
  std::size_t places = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    places += i > 0 && (runs[i].block != runs[i - 1].block || runs[i].drop != runs[i - 1].drop);
    if ((i + places) % n == 0) some.push_back(runs[i]);
  }
  return some;
}

Result<std::vector<ProfileComparison>> compare(const QuarryScene& quarry, const ValidateCommand& command) {
  std::vector<ProfileComparison> comparisons;
  for (std::size_t profile = 0; profile < quarry.data.profiles.size(); ++profile) {
    scenes::ProgressLine progress("blocks of " + quarry.data.profiles[profile].name);
    const std::vector<BlockRun> runs = everyNth(runsOf(quarry, profile), command.every);
    const auto ends =
        simulateBlocks(quarry, runs, command.jobs, [&](double done) { return progress.show("done", done); });
    if (!ends) return ends.error();
    comparisons.push_back(compareProfile(quarry, runs, ends.value()));
  }
  return comparisons;
}

Status checkFiles(const ValidateCommand& command) {
  const auto named = [](const std::optional<fs::path>& path) { return path.value_or(fs::path()); };
  return checkOutputs({named(command.settings)},
                      {named(command.calibrated), named(command.json), named(command.figure)});
}

}  // namespace

Status validate(const ValidateCommand& command) {
  if (const Status checked = checkFiles(command); !checked) return checked;
  auto settings = command.settings ? readSettings(*command.settings) : builtInSettings();
  if (!settings) return settings.error();
  auto quarry = prepare(command, settings.value());
  if (!quarry) return quarry.error();
  if (command.calibrated) {
    auto found = calibrated(command, quarry.value(), settings.value());
    if (!found) return found.error();
    settings = std::move(found);
    useSettings(quarry.value(), settings.value());
  }
  const auto comparisons = compare(quarry.value(), command);
  if (!comparisons) return comparisons.error();
  for (const std::string& repair : quarry.value().repairs) fmt::print("closed in the scan {}\n", repair);
  fmt::print("{}", validationText(comparisons.value()));
  if (command.figure)
    if (const Status drawn = writeFileAtomically(*command.figure, validationFigure(comparisons.value())); !drawn)
      return drawn;
  if (!command.json) return {};
  return writeFileAtomically(*command.json, validationJson(comparisons.value(), settings.value()));
}

}  // namespace cairn::rockfall
