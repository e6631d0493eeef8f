// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Runs `first` to `last` - 1.
struct RunRange {
  std::uint64_t first = 0, last = 0;
  friend bool operator==(const RunRange&, const RunRange&) = default;
};

/// Largest number of a run, plus one. It keeps seeds different and file names sorted.
inline constexpr std::uint64_t kMaxRuns = 1'000'000'000;

/// Reads a range "a:b" with a < b. Fails in one sentence for any other text.
Result<RunRange> parseRange(std::string_view text);

/// Returns part i of n, given as "i/n" and counted from 1. The ranges of all parts are disjoint, cover the whole, and
/// differ in size by at most one. With fewer runs than parts, a part may be empty. Fails in one sentence for any other
/// text.
Result<RunRange> partOf(const RunRange& range, std::string_view text);

/// How many runs these are.
std::uint64_t countOf(const std::vector<RunRange>& ranges);

/// The least range that holds both; one without runs counts for nothing.
RunRange hullOf(const RunRange& a, const RunRange& b);

/// Returns the runs as disjoint ranges in order. Precondition: `runs` is ascending.
std::vector<RunRange> rangesOf(const std::vector<std::uint64_t>& runs);

/// Names the runs, as in "3, 10 to 14"; of many ranges the first ones.
std::string textOf(const std::vector<RunRange>& ranges);

}  // namespace cairn::rockfall
