// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include "cairn/builder/grain.h"
#include "cairn/core/atomic_file.h"
#include "import/line_reader.h"

namespace cairn::builder {
namespace {

constexpr const char* kGive = "; give a file `cairn cover` wrote, or a tree";
/// Coordinates and radii up to this size, whose fifth powers still are numbers.
constexpr double kLargest = 1e60;

/// The numbers of the line the reader stands at.
Result<std::vector<double>> numbersOf(LineReader& line) {
  std::vector<double> numbers;
  for (std::string_view word = line.nextWord(); !word.empty(); word = line.nextWord()) {
    const std::optional<double> value = parseNumber<double>(word);
    if (!value) return line.error(fmt::format("'{}' is not a number{}", word, kGive));
    if (!(std::abs(*value) <= kLargest)) return line.error(fmt::format("{} is no length a sphere can have", word));
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace

Result<std::vector<Ball>> readCover(const std::string& path) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  LineReader line(path, {reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
  std::vector<Ball> balls;
  while (line.nextContent()) {
    const Result<std::vector<double>> numbers = numbersOf(line);
    if (!numbers) return numbers.error();
    const std::vector<double>& n = numbers.value();
    if (n.size() < 4) return line.error(fmt::format("a sphere needs four numbers `x y z r`{}", kGive));
    if (!(n[3] > 0)) return line.error(fmt::format("the radius {} is not above 0; correct it", n[3]));
    balls.push_back({{n[0], n[1], n[2]}, n[3], 0});
  }
  if (balls.empty()) return line.atEnd(std::string("holds no sphere") + kGive);
  return balls;
}

}  // namespace cairn::builder
