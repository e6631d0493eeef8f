// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "rockfall/ensemble/run_file.h"
#include "rockfall/ensemble/run_range.h"

namespace cairn::rockfall {

struct EnsembleOptions {
  RunRange runs;
  std::filesystem::path folder;
  std::uint32_t jobs = 1;  ///< processes
};

struct EnsembleReport {
  std::uint64_t computed = 0, kept = 0;
};

/// Computes the runs of a range that the folder does not hold yet, each into a file of its own, then writes the
/// manifest. Whatever kills it, what is finished stays, and the same call goes on from there. Any number of processes
/// may fill one folder. `document` is the case without comments, for the manifest.
///
/// Fails for a folder that holds runs of another scene or versions, for a run file that is damaged, as `simulate`
/// fails, and with `builder::kCancelled` once `keepGoing` says no; with several jobs in the sentence of the first that
/// failed. Precondition with several jobs: no other threads of this process hold locks.
Result<EnsembleReport> computeRuns(const Scene& scene, const Json& document, const EnsembleOptions& options,
                                   const std::function<bool(std::uint64_t done, std::uint64_t all)>& keepGoing);

/// Numbers of the run files in a folder, rising. Nothing is read.
std::vector<std::uint64_t> runsIn(const std::filesystem::path& folder);

}  // namespace cairn::rockfall
