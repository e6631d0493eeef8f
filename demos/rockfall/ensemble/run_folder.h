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
  RunRange whole = {};     ///< of which the runs are a part, so that a merge can tell which are missing
};

struct EnsembleReport {
  std::uint64_t computed = 0, kept = 0;
};

/// Writes the manifest, then computes the runs of a range that are missing in the folder, each into a file of its own.
/// After an interruption, finished runs stay, and the same call continues from there. Any number of processes may fill
/// one folder. `document` is the case without comments, for the manifest.
///
/// Fails for a folder with runs of another scene or version, for a damaged run file, and as `simulate` does. Fails with
/// `builder::kCancelled` once `keepGoing` returns false. With several jobs, the error is that of the first failed job.
/// Precondition with several jobs: no other thread of this process holds a lock.
Result<EnsembleReport> computeRuns(const Scene& scene, const Json& document, const EnsembleOptions& options,
                                   const std::function<bool(std::uint64_t done, std::uint64_t all)>& keepGoing);

/// Returns the numbers of the run files in a folder, ascending. No file is read.
std::vector<std::uint64_t> runsIn(const std::filesystem::path& folder);

}  // namespace cairn::rockfall
