// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Reads a text line by line and word by word, and counts lines for error messages.
///
///     LineReader line("part.obj", text);
///     while (line.nextContent()) statement(line.nextWord(), line);
class LineReader {
 public:
  /// Whether a line may continue in the next one.
  enum class Continued { Never, ByBackslash };

  LineReader(std::string file, std::string_view text, Continued continued = Continued::Never)
      : file_(std::move(file)), rest_(text), continued_(continued) {}

  bool nextLine() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }

  /// Moves to the next line with more than blanks and a `#` comment; false at the end of the text.
  bool nextContent() {
    while (nextLine()) {
      dropComment();
      if (line_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
    }
    return false;
  }

  /// Returns the next word; empty at the end of the line.
  std::string_view nextWord() {
    std::string_view word = wordOfLine();
    while (continued_ == Continued::ByBackslash && word.ends_with('\\') && isAtEnd()) {
      word.remove_suffix(1);
      if (!nextLine()) break;
      dropComment();
      if (!word.empty()) break;
      word = wordOfLine();
    }
    return word;
  }

  /// Skips the rest of the line.
  void passOver() { line_ = {}; }

  std::size_t number() const { return number_; }
  /// The text after the current line.
  std::string_view rest() const { return rest_; }
  Error error(std::string_view what) const { return Error{fmt::format("{}, line {}: {}", file_, number_, what)}; }
  Error atEnd(std::string_view what) const { return Error{fmt::format("{}: {}", file_, what)}; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\v\f";

  void dropComment() { line_ = line_.substr(0, line_.find('#')); }
  bool isAtEnd() const { return line_.find_first_not_of(kBlanks) == std::string_view::npos; }

  std::string_view wordOfLine() {
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
    const std::string_view word = line_.substr(0, line_.find_first_of(kBlanks));
    line_.remove_prefix(word.size());
    return word;
  }

  std::string file_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
  Continued continued_;
};

/// Reads a number out of the range of double: zero when it is too small, infinity when it is too large.
inline double valueOutOfRange(std::string_view number) {
  std::istringstream in{std::string(number)};
  in.imbue(std::locale::classic());
  double value = 0;
  in >> value;
  return in.fail() ? std::copysign(std::numeric_limits<double>::infinity(), value) : value;
}

/// Returns the number that a whole word represents; nothing for any other word.
template <class T>
std::optional<T> parseNumber(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc{}) return value;
  if constexpr (std::is_floating_point_v<T>)
    if (error == std::errc::result_out_of_range) return T(valueOutOfRange(word));
  return std::nullopt;
}

}  // namespace cairn::builder
