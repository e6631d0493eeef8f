// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/run_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace cairn::rockfall {
namespace {

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > kMaxRuns) return {};
  return value;
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> twoNumbers(std::string_view text, char between) {
  const std::size_t middle = text.find(between);
  if (middle == std::string_view::npos) return {};
  const auto first = wholeNumber(text.substr(0, middle)), second = wholeNumber(text.substr(middle + 1));
  if (!first || !second) return {};
  return std::pair{*first, *second};
}

}  // namespace

Result<RunRange> parseRange(std::string_view text) {
  const auto numbers = twoNumbers(text, ':');
  if (!numbers || numbers->first >= numbers->second)
    return Error{fmt::format("'{}' is no range of runs: use a:b for the runs a to b - 1, as in 0:100", text)};
  return RunRange{numbers->first, numbers->second};
}

Result<RunRange> partOf(const RunRange& range, std::string_view text) {
  const auto numbers = twoNumbers(text, '/');
  if (!numbers || numbers->first < 1 || numbers->first > numbers->second)
    return Error{fmt::format("'{}' is no part: use i/n for the i-th of n parts, as in 3/8", text)};
  const auto [part, parts] = *numbers;
  const std::uint64_t count = range.last - range.first;
  // Both factors are below 2^30.
  return RunRange{range.first + count * (part - 1) / parts, range.first + count * part / parts};
}

std::uint64_t countOf(const std::vector<RunRange>& ranges) {
  std::uint64_t count = 0;
  for (const RunRange& range : ranges) count += range.last - range.first;
  return count;
}

RunRange hullOf(const RunRange& a, const RunRange& b) {
  if (a.first >= a.last) return b;
  if (b.first >= b.last) return a;
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

std::vector<RunRange> rangesOf(const std::vector<std::uint64_t>& runs) {
  std::vector<RunRange> ranges;
  for (const std::uint64_t run : runs) {
    if (!ranges.empty() && ranges.back().last == run)
      ++ranges.back().last;
    else
      ranges.push_back({run, run + 1});
  }
  return ranges;
}

std::string textOf(const std::vector<RunRange>& ranges) {
  constexpr std::size_t kMost = 8;  // that a reader takes in
  std::string text;
  for (std::size_t i = 0; i < std::min(ranges.size(), kMost); ++i) {
    const auto& [first, last] = ranges[i];
    text += i == 0 ? "" : ", ";
    text += last - first == 1 ? fmt::format("{}", first) : fmt::format("{} to {}", first, last - 1);
  }
  if (ranges.size() > kMost) text += fmt::format(" and {} more", ranges.size() - kMost);
  return text;
}

}  // namespace cairn::rockfall
