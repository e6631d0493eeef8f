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

/// Largest number a run may have, plus one: what keeps seeds apart and file names sorted.
inline constexpr std::uint64_t kMaxRuns = 1'000'000'000;

/// "a:b", a below b. Fails in one sentence otherwise.
Result<RunRange> parseRange(std::string_view text);

/// Part i of n as "i/n", counted from 1: the ranges of all parts are disjoint, together the whole, and their sizes
/// differ by one at most. A part of fewer runs than parts may be empty. Fails in one sentence for what is no such text.
Result<RunRange> partOf(const RunRange& range, std::string_view text);

/// Runs as disjoint ranges in order. Precondition: `runs` rise.
std::vector<RunRange> rangesOf(const std::vector<std::uint64_t>& runs);

}  // namespace cairn::rockfall
