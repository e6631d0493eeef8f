// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Walks the lines of a text and the words of a line, and knows the line's number.
class LineReader {
 public:
  LineReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  bool nextLine() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }

  /// The next line that holds more than blanks and a `#` comment.
  bool nextContent() {
    while (nextLine()) {
      line_ = line_.substr(0, line_.find('#'));
      if (line_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
    }
    return false;
  }

  /// Empty at the end of the line.
  std::string_view nextWord() {
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
    const std::string_view word = line_.substr(0, line_.find_first_of(kBlanks));
    line_.remove_prefix(word.size());
    return word;
  }

  std::size_t number() const { return number_; }
  /// What follows the line read last.
  std::string_view rest() const { return rest_; }
  Error error(std::string_view what) const { return Error{fmt::format("{}, line {}: {}", file_, number_, what)}; }
  Error atEnd(std::string_view what) const { return Error{fmt::format("{}: {}", file_, what)}; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\v\f";

  std::string file_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

/// The number a whole word stands for.
template <class T>
std::optional<T> parseNumber(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace cairn::builder
