// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/ascii_grid.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "cairn/core/atomic_file.h"

namespace cairn::rockfall {

namespace {

constexpr double kUsualNoData = -9999;
constexpr double kSquare = 1e-6;           // by how much of itself a cell may be longer than wide
constexpr std::size_t kLongestShown = 24;  // of a word from the file, in an error

// The words of a text and the lines they are on.
class Words {
 public:
  Words(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// The next word, empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && isSpace(text_[at_]))
      if (text_[at_++] == '\n') ++lineAhead_;
    line_ = lineAhead_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::size_t left() const { return text_.size() - at_; }
  Error error(const std::string& what) const { return Error{name_ + ", line " + std::to_string(line_) + ": " + what}; }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0, line_ = 1, lineAhead_ = 1;
};

// As it may be printed: what comes from outside can hold anything.
std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, kLongestShown)) text += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return "\"" + text + (word.size() > kLongestShown ? "...\"" : "\"");
}

bool isKey(std::string_view word, std::string_view key) {
  return std::ranges::equal(word, key, [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  });
}

std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

struct Header {
  std::uint32_t columns = 0, rows = 0;
  double cell = 1, x = 0, y = 0;
  bool isXCorner = false, isYCorner = false;
  double noData = kUsualNoData;
};

// Whether they are one number in single precision, of which programs print more digits or fewer.
bool isSameFloat(double a, double b) {
  constexpr double kHalfUlp = 0x1p-24;
  return std::abs(a - b) <= kHalfUlp * std::abs(b);
}

class GridReader {
 public:
  GridReader(std::string_view text, const std::string& name) : words_(text, name), name_(name) {}

  Result<Raster> read() {
    if (Status status = readHeader(); !status) return status.error();
    if (Status status = checkRasterSize(header_.columns, header_.rows); !status)
      return Error{name_ + " " + status.error().message};
    const std::size_t count = std::size_t(header_.columns) * header_.rows;
    // A value takes a character and, but for the last, a space: nothing is allocated for what cannot be there.
    if (words_.left() + word_.size() < 2 * count - 1)
      return Error{name_ + " is too short for " + std::to_string(count) + " values: it may have been cut off"};
    Raster raster{header_.columns, header_.rows, header_.cell, header_.x, header_.y, {}, {}};
    if (header_.isXCorner) raster.x += 0.5 * header_.cell;
    if (header_.isYCorner) raster.y += 0.5 * header_.cell;
    raster.values.resize(count);
    if (Status status = readValues(raster); !status) return status.error();
    return raster;
  }

 private:
  Status readCount(std::string_view key, std::uint32_t& count) {
    if (Status status = expectKey(key); !status) return status;
    const std::string_view word = words_.next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || end != word.data() + word.size() || count == 0)
      return words_.error(std::string(key) + " is " + shown(word) + ": give a positive whole number");
    return {};
  }
  Status readNumber(std::string_view key, double& number) {
    const std::string_view word = words_.next();
    const std::optional<double> value = numberOf(word);
    if (!value || !std::isfinite(*value))
      return words_.error(std::string(key) + " is " + shown(word) + ": give a finite number");
    number = *value;
    return {};
  }
  Status expectKey(std::string_view key) {
    const std::string_view word = words_.next();
    if (isKey(word, key)) return {};
    return words_.error("found " + shown(word) + " where " + std::string(key) + " has to be");
  }
  // `xllcorner` or `xllcenter`.
  Status readPlace(const std::string& axis, double& place, bool& isCorner) {
    const std::string_view word = words_.next();
    isCorner = isKey(word, axis + "llcorner");
    if (!isCorner && !isKey(word, axis + "llcenter"))
      return words_.error("found " + shown(word) + " where " + axis + "llcorner or " + axis + "llcenter has to be");
    return readNumber(axis + (isCorner ? "llcorner" : "llcenter"), place);
  }
  // `cellsize`, or `dx` and `dy` as GDAL writes them, where they say the same.
  Status readCell() {
    const std::string_view word = words_.next();
    const bool isByAxis = isKey(word, "dx");
    if (!isByAxis && !isKey(word, "cellsize"))
      return words_.error("found " + shown(word) + " where cellsize has to be");
    const char* const key = isByAxis ? "dx" : "cellsize";
    if (Status status = readNumber(key, header_.cell); !status) return status;
    if (header_.cell <= 0)
      return words_.error(std::string(key) + " is not positive: give the distance of two values in metres");
    if (!isByAxis) return {};
    double dy = 0;
    if (Status status = expectKey("dy"); !status) return status;
    if (Status status = readNumber("dy", dy); !status) return status;
    if (std::abs(dy - header_.cell) <= kSquare * header_.cell) return {};
    return words_.error("has cells of " + std::to_string(header_.cell) + " x " + std::to_string(dy) +
                        " m: warp it to square ones first");
  }
  Status readHeader() {
    if (Status status = readCount("ncols", header_.columns); !status) return status;
    if (Status status = readCount("nrows", header_.rows); !status) return status;
    if (Status status = readPlace("x", header_.x, header_.isXCorner); !status) return status;
    if (Status status = readPlace("y", header_.y, header_.isYCorner); !status) return status;
    if (Status status = readCell(); !status) return status;
    word_ = words_.next();
    if (!isKey(word_, "nodata_value")) return {};
    word_ = words_.next();
    const std::optional<double> value = numberOf(word_);
    if (!value) return words_.error("NODATA_value is " + shown(word_) + ": give a number");
    header_.noData = *value;
    word_ = words_.next();
    return {};
  }
  // From the top, the first of them is in `word_`.
  Status readValues(Raster& raster) {
    for (std::uint32_t row = raster.rows; row-- > 0;)
      for (std::uint32_t column = 0; column < raster.columns; ++column) {
        if (word_.empty())
          return words_.error("the file ends after " +
                              std::to_string(std::size_t(raster.rows - 1 - row) * raster.columns + column) + " of " +
                              std::to_string(raster.values.size()) + " values");
        const std::optional<double> value = numberOf(word_);
        const bool isNone = value && (std::isnan(*value) || isSameFloat(*value, header_.noData));
        if (!value || (!isNone && !std::isfinite(*value)))
          return words_.error("the value is " + shown(word_) + ": give a finite number or NODATA_value");
        raster.at(column, row) = isNone ? std::numeric_limits<double>::quiet_NaN() : *value;
        word_ = words_.next();
      }
    if (!word_.empty()) return words_.error("found " + shown(word_) + " after the last value");
    return {};
  }

  Words words_;
  const std::string& name_;
  std::string_view word_;  // read, but not used yet
  Header header_;
};

void append(std::string& text, double number) {
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
}

// Programs know corners better, but adding half a cell again may not give the same number. One of each is what some
// cannot read.
void appendPlace(std::string& text, const Raster& raster) {
  const double half = 0.5 * raster.cell;
  const auto isExact = [&](double place) { return place - half + half == place; };
  const bool isCorner = isExact(raster.x) && isExact(raster.y);
  for (const auto& [axis, place] : {std::pair{'x', raster.x}, std::pair{'y', raster.y}}) {
    text += axis;
    text += isCorner ? "llcorner " : "llcenter ";
    append(text, isCorner ? place - half : place);
    text += '\n';
  }
}

double unusedNumber(const std::vector<double>& values) {
  double number = kUsualNoData;
  while (std::ranges::find(values, number) != values.end()) number = 10 * number - 9;  // -9999, -99999, ...
  return number;
}

}  // namespace

Result<Raster> parseAsciiGrid(std::string_view text, const std::string& name) {
  return GridReader(text, name).read();
}

Result<Raster> readAsciiGrid(const std::filesystem::path& path) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
  return parseAsciiGrid(text, path.string());
}

std::string asciiGrid(const Raster& raster) {
  std::string text = "ncols " + std::to_string(raster.columns) + "\nnrows " + std::to_string(raster.rows) + "\n";
  appendPlace(text, raster);
  text += "cellsize ";
  append(text, raster.cell);
  const double noData = unusedNumber(raster.values);
  text += "\nNODATA_value ";
  append(text, noData);
  text += '\n';
  for (std::uint32_t row = raster.rows; row-- > 0;)
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const double value = raster.at(column, row);
      append(text, std::isnan(value) ? noData : value);
      text += column + 1 < raster.columns ? ' ' : '\n';
    }
  return text;
}

Status writeAsciiGrid(const std::filesystem::path& path, const Raster& raster) {
  return writeFileAtomically(path, asciiGrid(raster));
}

}  // namespace cairn::rockfall
