// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace cairn::builder::ply {
namespace {

Type typeNamed(std::string_view name) {
  struct Named {
    std::string_view name, other;
    Type type;
  };
  static constexpr Named kTypes[] = {
      {"char", "int8", {Kind::signedInteger, 1}},   {"uchar", "uint8", {Kind::unsignedInteger, 1}},
      {"short", "int16", {Kind::signedInteger, 2}}, {"ushort", "uint16", {Kind::unsignedInteger, 2}},
      {"int", "int32", {Kind::signedInteger, 4}},   {"uint", "uint32", {Kind::unsignedInteger, 4}},
      {"float", "float32", {Kind::real, 4}},        {"double", "float64", {Kind::real, 8}}};
  for (const Named& t : kTypes)
    if (name == t.name || name == t.other) return t.type;
  return {};
}

Role roleOf(const std::string& element, const Property& property, std::string_view name) {
  if (element == "vertex" && !property.isList())
    return name == "x" ? Role::x : name == "y" ? Role::y : name == "z" ? Role::z : Role::none;
  const bool isOfVertices =
      property.isList() && property.type.kind != Kind::real && (name == "vertex_indices" || name == "vertex_index");
  if (!isOfVertices) return Role::none;
  return element == "face" ? Role::corners : element == "tristrips" ? Role::strips : Role::none;
}

Status readProperty(LineReader& line, Header& header) {
  Property property;
  std::string_view type = line.nextWord();
  if (type == "list") {
    property.countType = typeNamed(line.nextWord());
    if (property.countType.kind == Kind::unknown || property.countType.kind == Kind::real)
      return line.error("a list's length has an unknown type; export again");
    type = line.nextWord();
  }
  property.type = typeNamed(type);
  if (property.type.kind == Kind::unknown)
    return line.error(fmt::format("'{}' is not a type of PLY; export the mesh again", type));
  if (header.elements.empty()) return line.error("a property comes before any element; export the mesh again");
  Element& element = header.elements.back();
  const std::string_view name = line.nextWord();
  if (name.empty()) return line.error("a property needs a name; export the mesh again");
  property.role = roleOf(element.name, property, name);
  element.properties.push_back(property);
  return {};
}

Status readFormat(LineReader& line, std::optional<Encoding>& encoding) {
  const std::string_view format = line.nextWord();
  if (format == "ascii") encoding = Encoding::text;
  if (format == "binary_little_endian") encoding = Encoding::littleEndian;
  if (format == "binary_big_endian") encoding = Encoding::bigEndian;
  if (!encoding || line.nextWord() != "1.0")
    return line.error("the format is not ascii, binary_little_endian or binary_big_endian 1.0; export the mesh again");
  return {};
}

Status readElement(LineReader& line, Header& header) {
  Element element;
  element.name = std::string(line.nextWord());
  const auto count = parseNumber<std::uint64_t>(line.nextWord());
  if (!count) return line.error("an element needs a name and a count; export the mesh again");
  element.count = *count;
  header.elements.push_back(element);
  return {};
}

Status readLine(LineReader& line, std::string_view keyword, Header& header) {
  if (keyword == "element") return readElement(line, header);
  if (keyword == "property") return readProperty(line, header);
  if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return {};  // nothing about the data
  return line.error("this is no line of a PLY header; export the mesh again");
}

}  // namespace

bool Element::has(Role role) const {
  return std::any_of(properties.begin(), properties.end(), [&](const Property& p) { return p.role == role; });
}

bool Header::has(Role role) const {
  return std::any_of(elements.begin(), elements.end(), [&](const Element& e) { return e.has(role); });
}

std::uint64_t Header::vertices() const {
  std::uint64_t sum = 0;
  for (const Element& e : elements) sum += e.name == "vertex" ? e.count : 0;
  return sum;
}

Result<Header> readHeader(LineReader& line) {
  if (!line.nextLine() || line.nextWord() != "ply")
    return line.error("a PLY file begins with the word ply; check that this is one");
  Header header;
  std::optional<Encoding> encoding;
  while (line.nextLine()) {
    const std::string_view keyword = line.nextWord();
    if (keyword == "end_header" && !encoding) return line.error("the header names no format; export the mesh again");
    if (keyword == "end_header") {
      header.encoding = *encoding;
      return header;
    }
    if (Status s = keyword == "format" ? readFormat(line, encoding) : readLine(line, keyword, header); !s)
      return s.error();
  }
  return line.error("the header does not end with end_header; the file is truncated, export it again");
}

}  // namespace cairn::builder::ply
