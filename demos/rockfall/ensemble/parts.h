// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include "rockfall/ensemble/manifest.h"
#include "rockfall/ensemble/run_file.h"

namespace cairn::rockfall {

/// Finished runs of one scene, in any number of folders. The result depends neither on the order of the folders nor on
/// the distribution of the runs.
class Parts {
 public:
  /// Opens folders of runs. Fails in one sentence for folders without a manifest, of different scenes or versions, and
  /// without runs. Copies of one run in several folders must be equal.
  static Result<Parts> open(const std::vector<std::filesystem::path>& folders);

  const Manifest& manifest() const { return manifest_; }
  std::vector<RunRange> runs() const;
  /// The others, from the first run that was asked for, or is there, to the last.
  std::vector<RunRange> missing() const;

  /// Calls `use` for every run once, in ascending order of numbers. Fails as `readRunFile` and `use` do.
  Status forEach(const std::function<Status(const RunFile&)>& use) const;

 private:
  Status add(const std::filesystem::path& folder);

  Manifest manifest_;
  RunRange asked_;
  std::map<std::uint64_t, std::vector<std::filesystem::path>> files_;
};

}  // namespace cairn::rockfall
