// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/parts.h"

#include <fmt/format.h>

#include <utility>

#include "rockfall/ensemble/run_folder.h"

namespace cairn::rockfall {

Result<Parts> Parts::open(const std::vector<std::filesystem::path>& folders) {
  Parts parts;
  for (const auto& folder : folders)
    if (const Status added = parts.add(folder); !added) return added.error();
  if (parts.files_.empty()) return Error{"there are no runs to merge"};
  return parts;
}

Status Parts::add(const std::filesystem::path& folder) {
  auto manifest = readManifest(folder);
  if (!manifest) return manifest.error();
  const Manifest& own = manifest.value();
  if (!manifest_.sceneHash.empty() && (own.sceneHash != manifest_.sceneHash || own.versions != manifest_.versions))
    return Error{fmt::format("{} holds runs of another case, other trees or other versions than the folders before it",
                             folder.string())};
  asked_ = hullOf(asked_, own.asked);
  for (const std::uint64_t run : runsIn(folder)) {
    asked_ = hullOf(asked_, {run, run + 1});
    files_[run].push_back(folder / runFileName(run));
  }
  if (manifest_.sceneHash.empty()) manifest_ = std::move(manifest).value();
  return {};
}

std::vector<RunRange> Parts::runs() const {
  std::vector<std::uint64_t> runs;
  for (const auto& [run, files] : files_) runs.push_back(run);
  return rangesOf(runs);
}

std::vector<RunRange> Parts::missing() const {
  std::vector<RunRange> missing;
  std::uint64_t next = asked_.first;
  for (const RunRange& there : runs()) {
    if (there.first > next) missing.push_back({next, there.first});
    next = there.last;
  }
  if (asked_.last > next) missing.push_back({next, asked_.last});
  return missing;
}

Status Parts::forEach(const std::function<Status(const RunFile&)>& use) const {
  for (const auto& [run, files] : files_) {
    const auto first = readRunFile(files.front());
    if (!first) return first.error();
    if (first.value().sceneHash != manifest_.sceneHash || first.value().versions != manifest_.versions)
      return Error{fmt::format("{} is of another scene or other versions than its manifest", files.front().string())};
    for (std::size_t i = 1; i < files.size(); ++i) {
      const auto other = readRunFile(files[i]);
      if (!other) return other.error();
      if (other.value().resultHash != first.value().resultHash)
        return Error{
            fmt::format("{} and {} differ: a run is the same wherever it is computed, unless microseconds are "
                        "its budget",
                        files.front().string(), files[i].string())};
    }
    if (const Status used = use(first.value()); !used) return used;
  }
  return {};
}

}  // namespace cairn::rockfall
