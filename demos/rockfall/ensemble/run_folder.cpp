// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "rockfall/ensemble/manifest.h"
#include "rockfall/ensemble/workers.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;

using KeepGoing = std::function<bool(std::uint64_t done, std::uint64_t all)>;

Status makeFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", folder.string(), failure.message())};
  return {};
}

Error ofAnotherScene(const fs::path& what) {
  return Error{
      fmt::format("{} is of another case, other trees or other versions: choose another folder", what.string())};
}

/// Returns the missing runs of the range. Existing run files must be complete and of this scene.
Result<std::vector<std::uint64_t>> missingRuns(const Scene& scene, const EnsembleOptions& options) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t run = options.runs.first; run < options.runs.last; ++run) {
    const fs::path file = options.folder / runFileName(run);
    if (!fs::exists(file)) {
      missing.push_back(run);
      continue;
    }
    const auto kept = readRunFile(file);
    if (!kept) return kept.error();
    if (kept.value().sceneHash != scene.hash || kept.value().versions != versionsOfThisProgram())
      return ofAnotherScene(file);
  }
  return missing;
}

/// Computes every `stride`-th of the runs, from `first` on.
Status computeSome(const Scene& scene, const fs::path& folder, const std::vector<std::uint64_t>& runs,
                   std::size_t first, std::size_t stride, const KeepGoing& keepGoing) {
  for (std::size_t i = first; i < runs.size(); i += stride) {
    const auto run = simulate(scene, runs[i], [&] { return !keepGoing || keepGoing(i, runs.size()); });
    if (!run) return run.error();
    if (const Status written = writeRunFile(folder, scene.hash, run.value()); !written) return written;
  }
  return {};
}

}  // namespace

std::vector<std::uint64_t> runsIn(const fs::path& folder) {
  std::vector<std::uint64_t> runs;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t run = 0;
    if (name.size() > 4) std::from_chars(name.data() + 4, name.data() + name.size(), run);
    if (name == runFileName(run)) runs.push_back(run);
  }
  std::ranges::sort(runs);
  return runs;
}

namespace {

/// Writes down which runs are asked for, here and in other parts, before they are computed: so `merge` knows of those
/// that never were. A folder without runs belongs to no scene yet.
Status ask(const Scene& scene, const Json& document, const EnsembleOptions& options) {
  // A case file named without a folder has an empty folder.
  Manifest manifest{document,
                    fs::weakly_canonical(fs::current_path() / scene.description.folder).string(),
                    scene.description.hash,
                    scene.hash,
                    versionsOfThisProgram(),
                    hullOf(options.runs, options.whole)};
  if (fs::exists(options.folder / kManifestName) && !runsIn(options.folder).empty()) {
    const auto before = readManifest(options.folder);
    if (!before) return before.error();
    if (before.value().sceneHash != scene.hash || before.value().versions != manifest.versions)
      return ofAnotherScene(options.folder);
    manifest.asked = hullOf(manifest.asked, before.value().asked);
    if (manifest.asked == before.value().asked) return {};
  }
  return writeManifest(options.folder, manifest);
}

}  // namespace

Result<EnsembleReport> computeRuns(const Scene& scene, const Json& document, const EnsembleOptions& options,
                                   const KeepGoing& keepGoing) {
  if (const Status made = makeFolder(options.folder); !made) return made.error();
  if (const Status asked = ask(scene, document, options); !asked) return asked.error();
  const auto missing = missingRuns(scene, options);
  if (!missing) return missing.error();
  const auto jobs = static_cast<std::uint32_t>(std::min<std::size_t>(options.jobs, missing.value().size()));
  const auto work = [&](std::uint32_t worker) {
    return computeSome(scene, options.folder, missing.value(), worker, jobs, keepGoing);
  };
  const Status computed = jobs > 1 ? inProcesses(jobs, work) : jobs == 1 ? work(0) : Status();
  if (!computed) return computed.error();
  // Again: another process may have written its own meanwhile.
  if (const Status asked = ask(scene, document, options); !asked) return asked.error();
  const std::uint64_t all = options.runs.last - options.runs.first;
  return EnsembleReport{missing.value().size(), all - missing.value().size()};
}

}  // namespace cairn::rockfall
