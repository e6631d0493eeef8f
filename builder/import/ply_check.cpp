// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/ply_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "import/line_reader.h"

namespace cairn::builder {
namespace {

struct Property {
  std::string name;
  std::size_t size = 0;       // bytes of one value
  std::size_t countSize = 0;  // bytes of a list's length; 0 when not a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, littleEndian, bigEndian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

/// 0 for a type PLY does not have.
std::size_t sizeOfType(std::string_view type) {
  for (const char* name : {"char", "uchar", "int8", "uint8"})
    if (type == name) return 1;
  for (const char* name : {"short", "ushort", "int16", "uint16"})
    if (type == name) return 2;
  for (const char* name : {"int", "uint", "int32", "uint32", "float", "float32"})
    if (type == name) return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

Status readProperty(LineReader& line, Header& header) {
  Property property;
  std::string_view type = line.nextWord();
  if (type == "list") {
    property.countSize = sizeOfType(line.nextWord());
    if (property.countSize == 0 || property.countSize > 4)
      return line.error("a list's length has an unknown type; export again");
    type = line.nextWord();
  }
  property.size = sizeOfType(type);
  if (property.size == 0) return line.error(fmt::format("'{}' is not a type of PLY; export the mesh again", type));
  property.name = std::string(line.nextWord());
  if (header.elements.empty()) return line.error("a property comes before any element; export the mesh again");
  header.elements.back().properties.push_back(property);
  return {};
}

Status readHeaderLine(LineReader& line, std::string_view keyword, Header& header) {
  if (keyword == "format") {
    const std::string_view format = line.nextWord();
    if (format == "binary_little_endian") header.encoding = Encoding::littleEndian;
    if (format == "binary_big_endian") header.encoding = Encoding::bigEndian;
  } else if (keyword == "element") {
    Element element;
    element.name = std::string(line.nextWord());
    const auto count = parseNumber<std::uint64_t>(line.nextWord());
    if (!count) return line.error("an element needs a name and a count; export the mesh again");
    element.count = *count;
    header.elements.push_back(element);
  } else if (keyword == "property") {
    return readProperty(line, header);
  }
  return {};  // comments and obj_info say nothing about the data
}

Error truncated(const std::string& file, const Element& element, std::uint64_t found) {
  return Error{fmt::format("{}: the file ends after {} of {} elements '{}'; it is truncated, export it again", file,
                           found, element.count, element.name)};
}

/// The corners of a face: assimp stops the whole program when there are none.
bool holdsCorners(const Element& element, const Property& property) {
  return property.countSize != 0 && element.name == "face" &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::string tooFewCorners(std::uint64_t face, std::uint64_t corners) {
  return fmt::format("face {} has {} vertices, it needs three or more; remove it or export again", face, corners);
}

Status checkTextValues(LineReader& line, const Element& element, std::uint64_t index) {
  for (const Property& property : element.properties) {
    std::string_view word = line.nextWord();
    if (property.countSize != 0) {
      const auto length = parseNumber<std::uint32_t>(word);
      if (!length) return line.error("a list does not begin with its length; export again");
      if (holdsCorners(element, property) && *length < 3) return line.error(tooFewCorners(index, *length));
      for (std::uint32_t k = 0; k < *length && !word.empty(); ++k) word = line.nextWord();
    }
    if (word.empty()) return line.error("the line has too few values; the file may be truncated, export it again");
  }
  return {};
}

Status checkTextData(const std::string& file, LineReader& line, const Header& header) {
  for (const Element& element : header.elements) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!line.nextContent()) return truncated(file, element, i);
      if (Status s = checkTextValues(line, element, i); !s) return s;
    }
  }
  return {};
}

/// The unsigned integer of 1, 2 or 4 bytes at the front of `bytes`.
std::uint64_t frontInteger(std::string_view bytes, std::size_t size, Encoding encoding) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = encoding == Encoding::bigEndian ? i : size - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[at]);
  }
  return value;
}

Status checkBinaryData(const std::string& file, std::string_view bytes, const Header& header) {
  for (const Element& element : header.elements) {
    // Elements without properties take no room: any number of them is there.
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const Property& property : element.properties) {
        std::uint64_t values = 1;
        if (property.countSize != 0) {
          if (bytes.size() < property.countSize) return truncated(file, element, i);
          values = frontInteger(bytes, property.countSize, header.encoding);
          bytes.remove_prefix(property.countSize);
          if (holdsCorners(element, property) && values < 3)
            return Error{fmt::format("{}: {}", file, tooFewCorners(i, values))};
        }
        if (bytes.size() / property.size < values) return truncated(file, element, i);
        bytes.remove_prefix(values * property.size);
      }
    }
  }
  return {};
}

}  // namespace

Status checkPly(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  if (!line.nextLine() || line.nextWord() != "ply")
    return line.error("a PLY file begins with the word ply; check that this is one");
  Header header;
  while (line.nextLine()) {
    const std::string_view keyword = line.nextWord();
    if (keyword == "end_header") {
      return header.encoding == Encoding::text ? checkTextData(file, line, header)
                                               : checkBinaryData(file, line.rest(), header);
    }
    if (Status s = readHeaderLine(line, keyword, header); !s) return s;
  }
  return line.atEnd("the header does not end with end_header; the file is truncated, export it again");
}

}  // namespace cairn::builder
