// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "import/line_reader.h"

namespace cairn::builder::ply {

enum class Kind { unknown, signedInteger, unsignedInteger, real };

/// The type of a value. `size` is in bytes, 1 to 8; 0 when unknown.
struct Type {
  Kind kind = Kind::unknown;
  std::size_t size = 0;
};

/// The use that the reader has for a property.
enum class Role { none, x, y, z, corners, strips };

struct Property {
  Type type;
  Type countType;  ///< of a list's length; unknown for a property that is no list
  Role role = Role::none;

  bool isList() const { return countType.kind != Kind::unknown; }
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has(Role role) const;
};

enum class Encoding { text, littleEndian, bigEndian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;

  bool has(Role role) const;
  std::uint64_t vertices() const;
};

/// Reads up to the line `end_header`. Fails, with the line, for lines, encodings, types, elements and properties that
/// PLY does not have. Fails too when `format` or `end_header` is missing.
Result<Header> readHeader(LineReader& line);

}  // namespace cairn::builder::ply
