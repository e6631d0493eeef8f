// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/ply_reader.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "import/ply_header.h"

namespace cairn::builder {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Header;
using ply::Kind;
using ply::Property;
using ply::Role;
using ply::Type;

/// The values of a text, an item on each line.
class TextValues {
 public:
  explicit TextValues(LineReader& line) : line_(line) {}

  bool nextItem() { return line_.nextContent(); }
  bool goesOn() { return line_.nextContent(); }
  /// Returns nothing at the end of the line and for words that are no number.
  std::optional<double> number(Type) { return parseNumber<double>(line_.nextWord()); }
  /// False when there are fewer.
  bool skip(Type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i)
      if (line_.nextWord().empty()) return false;
    return true;
  }
  Error error(std::string_view what) const { return line_.error(what); }
  Error missing(const Element&, std::uint64_t) const {
    return line_.error("a value is missing or is no number; the file may be truncated, export it again");
  }

 private:
  LineReader& line_;
};

Error truncated(const LineReader& line, const Element& element, std::uint64_t found) {
  return line.atEnd(fmt::format("the file ends after {} of {} elements '{}'; it is truncated, export it again", found,
                                element.count, element.name));
}

/// The values of a binary file, one behind the other.
class BinaryValues {
 public:
  BinaryValues(const LineReader& line, Encoding encoding) : line_(line), bytes_(line.rest()), encoding_(encoding) {}

  bool nextItem() { return true; }
  /// Some files end with a line break or with padding.
  bool goesOn() const { return bytes_.find_first_not_of(std::string_view("\0 \t\r\n", 5)) != std::string_view::npos; }
  /// Returns nothing at the end of the file.
  std::optional<double> number(Type type) {
    if (bytes_.size() < type.size) return std::nullopt;
    const std::uint64_t bits = frontBits(type.size);
    bytes_.remove_prefix(type.size);
    if (type.kind == Kind::real)
      return type.size == 8 ? std::bit_cast<double>(bits) : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    const double value = static_cast<double>(bits);
    const double range = std::ldexp(1.0, static_cast<int>(8 * type.size));
    return type.kind == Kind::signedInteger && value >= range / 2 ? value - range : value;
  }
  bool skip(Type type, std::uint64_t count) {
    if (bytes_.size() / type.size < count) return false;
    bytes_.remove_prefix(count * type.size);
    return true;
  }
  Error error(std::string_view what) const { return line_.atEnd(what); }
  Error missing(const Element& element, std::uint64_t index) const { return truncated(line_, element, index); }

 private:
  std::uint64_t frontBits(std::size_t size) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = encoding_ == Encoding::bigEndian ? i : size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[at]);
    }
    return bits;
  }

  const LineReader& line_;
  std::string_view bytes_;
  Encoding encoding_;
};

/// True for an integer of 32 bits.
bool isWhole(double value) {
  return value >= 0 && value < 0x1p32 && value == std::floor(value);
}

/// Reads one item after the other into a soup. Only values of the needed properties are parsed.
template <class Values>
class Reader {
 public:
  Reader(Values values, const Header& header) : values_(values), vertices_(header.vertices()) {}

  Status readItem(const Element& element, std::uint64_t index) {
    Vec3d point;
    for (const Property& property : element.properties) {
      if (property.isList()) {
        if (Status s = readList(element, property, index); !s) return s;
      } else if (property.role == Role::none) {
        if (!values_.skip(property.type, 1)) return values_.missing(element, index);
      } else {
        const std::optional<double> value = values_.number(property.type);
        if (!value) return values_.missing(element, index);
        point[static_cast<int>(property.role) - static_cast<int>(Role::x)] = *value;
      }
    }
    if (element.name == "vertex") soup_.points.push_back(point);
    return {};
  }

  bool nextItem() { return values_.nextItem(); }
  Status end() {
    if (!values_.goesOn()) return {};
    return values_.error("the file goes on after the elements it promises; correct their counts or export it again");
  }
  PolygonSoup soup() && { return std::move(soup_); }

 private:
  Status readList(const Element& element, const Property& property, std::uint64_t index) {
    const std::optional<double> length = values_.number(property.countType);
    if (!length) return values_.missing(element, index);
    if (!isWhole(*length)) return values_.error("a list does not begin with its length; export again");
    const auto count = static_cast<std::uint32_t>(*length);
    if (property.role == Role::corners) return readCorners(element, property, index, count);
    if (property.role == Role::strips) return readStrips(element, property, index, count);
    return values_.skip(property.type, count) ? Status() : values_.missing(element, index);
  }

  Status readCorners(const Element& element, const Property& property, std::uint64_t face, std::uint32_t count) {
    if (count < 3)
      return values_.error(
          fmt::format("face {} has {} vertices, it needs three or more; remove it or export again", face, count));
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::optional<double> corner = values_.number(property.type);
      if (!corner) return values_.missing(element, face);
      if (!isVertex(*corner)) return noVertex("face", face, *corner);
      soup_.corners.push_back(static_cast<std::uint32_t>(*corner));
    }
    soup_.endPolygon();
    return {};
  }

  // Each vertex makes a triangle with the two before it. Every second one is reversed. -1 begins a new strip.
  Status readStrips(const Element& element, const Property& property, std::uint64_t strip, std::uint32_t count) {
    constexpr double kAnew = -1;
    std::array<std::uint32_t, 2> last{};
    std::uint64_t length = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::optional<double> corner = values_.number(property.type);
      if (!corner) return values_.missing(element, strip);
      if (*corner == kAnew) {
        length = 0;
        continue;
      }
      if (!isVertex(*corner)) return noVertex("strip", strip, *corner);
      const auto vertex = static_cast<std::uint32_t>(*corner);
      if (length >= 2) {
        const std::size_t first = length % 2;
        soup_.corners.insert(soup_.corners.end(), {last[first], last[1 - first], vertex});
        soup_.endPolygon();
      }
      last = {last[1], vertex};
      ++length;
    }
    return {};
  }

  bool isVertex(double number) const { return isWhole(number) && number < static_cast<double>(vertices_); }
  Error noVertex(std::string_view what, std::uint64_t index, double named) const {
    return values_.error(fmt::format("{} {} names vertex {} of {} (they count from 0); export the mesh again", what,
                                     index, named, vertices_));
  }

  Values values_;
  std::uint64_t vertices_;
  PolygonSoup soup_;
};

Status checkHoldsTriangles(const LineReader& line, const Header& header) {
  for (const Element& e : header.elements)
    if (e.name == "vertex" && !(e.has(Role::x) && e.has(Role::y) && e.has(Role::z)))
      return line.atEnd("its vertices have no x, y and z; export the mesh again");
  if (header.vertices() == 0) return line.atEnd("it has no vertices; export the mesh again");
  if (!header.has(Role::corners) && !header.has(Role::strips))
    return line.atEnd("it has no triangles: neither faces nor strips that list vertex_indices; export the mesh again");
  return {};
}

template <class Values>
Result<PolygonSoup> readItems(const LineReader& line, const Header& header, Values values) {
  Reader<Values> reader(values, header);
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // it takes no bytes, so any number of them is present
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!reader.nextItem()) return truncated(line, element, i);
      if (Status s = reader.readItem(element, i); !s) return s.error();
    }
  }
  if (Status s = reader.end(); !s) return s.error();
  return std::move(reader).soup();
}

}  // namespace

Result<PolygonSoup> readPly(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  const Result<Header> header = ply::readHeader(line);
  if (!header) return header.error();
  if (Status s = checkHoldsTriangles(line, header.value()); !s) return s.error();
  const Encoding encoding = header.value().encoding;
  return encoding == Encoding::text ? readItems(line, header.value(), TextValues(line))
                                    : readItems(line, header.value(), BinaryValues(line, encoding));
}

}  // namespace cairn::builder
