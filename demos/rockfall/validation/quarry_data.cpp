// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/quarry_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "cairn/core/atomic_file.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthestM = 1e4, kHeaviestKg = 1e6, kLargestM = 100, kFastestMPerS = 300;
constexpr double kUnit = 1e-3;  // by which a quaternion's length may differ from one: they are written with few digits
constexpr std::size_t kMaxLines = 100000;

struct Line {
  std::size_t number;
  std::vector<std::string_view> words;
};

/// A table of words, one line a row; lines with nothing on them are passed over.
class Table {
 public:
  static Result<Table> read(const fs::path& file, std::string_view separators) {
    auto content = readFile(file);
    if (!content) return content.error();
    Table table;
    table.file_ = file;
    table.text_.assign(reinterpret_cast<const char*>(content.value().data()), content.value().size());
    table.split(separators);
    if (table.lines_.empty()) return Error{file.string() + " is empty: give the data as they were published"};
    if (table.lines_.size() > kMaxLines)
      return Error{fmt::format("{} has more than {} lines: this is not the published table", file.string(), kMaxLines)};
    return table;
  }
  Table(Table&&) = default;
  Table& operator=(Table&&) = default;

  const std::vector<Line>& lines() const { return lines_; }
  Error refuse(const Line& line, const std::string& why) const {
    return Error{fmt::format("{}, line {}: {}", file_.string(), line.number, why)};
  }
  /// The numbers of a line from one column on.
  Result<std::vector<double>> numbers(const Line& line, std::size_t from, std::size_t count) const {
    if (line.words.size() != from + count)
      return refuse(line, fmt::format("has {} columns where {} belong", line.words.size(), from + count));
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view word = line.words[from + i];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), values[i]);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(values[i]))
        return refuse(line, fmt::format("'{}' is not a finite number", word.substr(0, 40)));
    }
    return values;
  }

 private:
  Table() = default;

  // The words look into the text, whose place on the heap stays: it is longer than what a string holds itself.
  void split(std::string_view separators) {
    text_.reserve(64);
    const std::string_view all = text_;
    std::size_t number = 0;
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find('\n', at), all.size());
      std::vector<std::string_view> words = wordsOf(all.substr(at, end - at), separators);
      ++number;
      if (!words.empty()) lines_.push_back({number, std::move(words)});
      at = end + 1;
    }
  }
  static std::vector<std::string_view> wordsOf(std::string_view line, std::string_view separators) {
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(separators, end);
    }
    return words;
  }

  fs::path file_;
  std::string text_;
  std::vector<Line> lines_;
};

constexpr std::string_view kBlanks = " \t\r", kCommas = ",\r";

std::optional<std::string> whyNoPlace(const Vec3d& place) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(place[axis]) <= kFarthestM))
      return fmt::format("a coordinate of {:g} m is farther than {:g} m from the data's origin", place[axis],
                         kFarthestM);
  return {};
}

Status readDrops(const fs::path& file, QuarryProfile& profile) {
  const auto table = Table::read(file, kBlanks);
  if (!table) return table.error();
  for (const Line& line : table.value().lines()) {
    const auto values = table.value().numbers(line, 0, 3);
    if (!values) return values.error();
    const Vec3d place(values.value()[0], values.value()[1], values.value()[2]);
    if (const auto why = whyNoPlace(place)) return table.value().refuse(line, *why);
    profile.drops.push_back(fromData(place));
    profile.dropLines.push_back(line.number);
  }
  return {};
}

Result<std::vector<MeasuredBlock>> readBlocks(const fs::path& file) {
  const auto table = Table::read(file, kBlanks);
  if (!table) return table.error();
  std::vector<MeasuredBlock> blocks;
  for (const Line& line : table.value().lines()) {
    const auto values = table.value().numbers(line, 0, 7);
    if (!values) return values.error();
    const auto& v = values.value();
    if (const auto why = whyNoPlace({v[0], v[1], v[2]})) return table.value().refuse(line, *why);
    if (!(v[3] > 0 && v[3] <= kHeaviestKg))
      return table.value().refuse(line, fmt::format("a mass of {:g} kg is none of a block", v[3]));
    if (!(v[6] > 0 && v[6] <= v[5] && v[5] <= v[4] && v[4] <= kLargestM))
      return table.value().refuse(line, "the box's lengths must be positive and must not rise");
    blocks.push_back({fromData({v[0], v[1], v[2]}), v[3], {v[4], v[5], v[6]}});
  }
  return blocks;
}

Result<std::vector<PublishedRun>> readPublished(const fs::path& file) {
  const auto table = Table::read(file, kCommas);
  if (!table) return table.error();
  std::vector<PublishedRun> runs;
  for (const Line& line : table.value().lines()) {
    if (line.number == 1) continue;  // the columns' names
    const auto values = table.value().numbers(line, 1, 7);
    if (!values) return values.error();
    const auto& v = values.value();
    if (const auto why = whyNoPlace({v[3], v[4], v[5]})) return table.value().refuse(line, *why);
    if (!(v[6] >= 0 && v[6] <= kFastestMPerS))
      return table.value().refuse(line, fmt::format("a speed of {:g} m/s is none of a block", v[6]));
    runs.push_back({std::string(line.words[0]), fromData({v[3], v[4], v[5]}), v[6]});
  }
  return runs;
}

Result<std::vector<std::array<double, 4>>> readOrientations(const fs::path& file) {
  const auto table = Table::read(file, kBlanks);
  if (!table) return table.error();
  std::vector<std::array<double, 4>> orientations;
  for (const Line& line : table.value().lines()) {
    if (line.number == 1 && line.words[0] == "q0") continue;
    const auto values = table.value().numbers(line, 0, 4);
    if (!values) return values.error();
    const auto& v = values.value();
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    if (!(std::abs(length - 1) <= kUnit))
      return table.value().refuse(line, fmt::format("a quaternion of length {:g} is no orientation", length));
    orientations.push_back({v[0] / length, v[1] / length, v[2] / length, v[3] / length});
  }
  if (orientations.empty()) return Error{file.string() + " has no orientations"};
  return orientations;
}

/// Into `to` what `read` gives of a file; nothing where there is none.
template <class Read, class To>
Status readIfThere(const fs::path& file, const Read& read, To& to) {
  if (std::error_code ignored; !fs::exists(file, ignored)) return {};
  auto values = read(file);
  if (!values) return values.error();
  to = std::move(values).value();
  return {};
}

Result<QuarryProfile> readProfile(const fs::path& folder, const std::string& name) {
  QuarryProfile profile;
  profile.name = name;
  if (const Status read = readDrops(dropsFile(folder, name), profile); !read) return read.error();
  if (const Status read = readIfThere(folder / ("Endpoints_" + name + ".txt"), readBlocks, profile.blocks); !read)
    return read.error();
  if (const Status read = readIfThere(folder / ("rockable_" + name + ".csv"), readPublished, profile.published); !read)
    return read.error();
  return profile;
}

}  // namespace

fs::path dropsFile(const fs::path& folder, const std::string& profile) {
  return folder / ("positions_" + profile + ".xyz");
}

Result<QuarryData> readQuarry(const fs::path& folder) {
  if (std::error_code ignored; !fs::is_directory(folder, ignored))
    return Error{folder.string() + " is no folder: name the one that holds the experiment's data (docs/validation.md)"};
  QuarryData data;
  data.folder = folder;
  for (const char* name : kProfileNames) {
    auto profile = readProfile(folder, name);
    if (!profile) return profile.error();
    data.profiles.push_back(std::move(profile).value());
  }
  auto orientations = readOrientations(folder / "orientations.txt");
  if (!orientations) return orientations.error();
  data.orientations = std::move(orientations).value();
  return data;
}

}  // namespace cairn::rockfall
