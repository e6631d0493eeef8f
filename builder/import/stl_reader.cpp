// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "import/line_reader.h"
#include "import/position_line.h"

namespace cairn::builder {
namespace {

/// The content of an STL; nothing when assimp must read it.
using StlPolygons = std::optional<PolygonSoup>;

std::string lowered(std::string_view word) {
  std::string lower(word);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return lower;
}

/// The block that is open at a statement.
enum class Open { Nothing, Solid, Facet, Loop, FacetWithLoop };

struct Statement {
  std::string_view word;
  Open before, after;
};

constexpr std::array<Statement, 7> kStatements{{{"solid", Open::Nothing, Open::Solid},
                                                {"facet", Open::Solid, Open::Facet},
                                                {"outer", Open::Facet, Open::Loop},
                                                {"vertex", Open::Loop, Open::Loop},
                                                {"endloop", Open::Loop, Open::FacetWithLoop},
                                                {"endfacet", Open::FacetWithLoop, Open::Solid},
                                                {"endsolid", Open::Solid, Open::Nothing}}};

/// Reads the statements of a text STL one by one.
class TextStl {
 public:
  TextStl(const std::string& file, std::string_view text) : line_(file, text) {}

  Result<PolygonSoup> read() {
    while (line_.nextContent()) {
      for (std::string_view word = line_.nextWord(); !word.empty(); word = line_.nextWord())
        if (Status s = readStatement(word); !s) return s.error();
    }
    if (open_ == Open::Nothing) return std::move(soup_);
    if (open_ == Open::Solid && soup_.ends.empty())
      return line_.error("no facet has been read up to here; export it with each statement on a line of its own");
    return line_.error(fmt::format(
        "the file ends after {} facets, without 'endsolid'; it is truncated, export it again", soup_.ends.size()));
  }

 private:
  Status readStatement(std::string_view written) {
    const std::string word = lowered(written);
    const auto statement = std::ranges::find(kStatements, std::string_view(word), &Statement::word);
    if (statement == kStatements.end())
      return line_.error(
          fmt::format("'{}' is no statement of a text STL; correct the line or export it again", written));
    if (statement->before != open_)
      return line_.error(fmt::format("'{}' comes {}; export it again", written, placeInGrammar()));
    const std::size_t corners = openCorners();
    open_ = statement->after;
    if (word == "vertex") return readVertex();
    if (word == "facet") return skipNormal();
    if (word == "outer" && lowered(line_.nextWord()) != "loop")
      return line_.error("'outer' is not followed by 'loop' on its line; correct it or export it again");
    if (word == "endloop") {
      if (corners < 3)
        return line_.error(fmt::format("a facet needs three vertices, this one has {}; export it again", corners));
      soup_.endPolygon();
    }
    if (word == "solid" || word == "endsolid") line_.passOver();  // its name
    return {};
  }

  /// The place of a statement that is not allowed there.
  std::string placeInGrammar() const {
    const std::size_t facet = soup_.ends.size() + (open_ == Open::FacetWithLoop ? 0 : 1);
    switch (open_) {
      case Open::Nothing:
        return "outside of a solid";
      case Open::Solid:
        return fmt::format("where facet {} or 'endsolid' is due", facet);
      case Open::Facet:
        return fmt::format("before the 'outer loop' of facet {}", facet);
      case Open::Loop:
        return fmt::format("before the 'endloop' of facet {}", facet);
      case Open::FacetWithLoop:
        return fmt::format("before the 'endfacet' of facet {}", facet);
    }
    return {};
  }

  Status readVertex() {
    const Result<Vec3d> position = readPosition(line_);
    if (!position) return position.error();
    soup_.corners.push_back(static_cast<std::uint32_t>(soup_.points.size()));
    soup_.points.push_back(position.value());
    return {};
  }

  /// Normals in files are often wrong and are not used.
  Status skipNormal() {
    std::string_view last = line_.nextWord();
    if (lowered(last) != "normal")
      return line_.error("'facet' is not followed by 'normal' on its line; correct it or export it again");
    for (int axis = 0; axis < 3; ++axis) last = line_.nextWord();
    if (last.empty())
      return line_.error("a normal needs three coordinates on its line; the file may be truncated, export it again");
    return {};
  }

  /// Number of corners since the last polygon.
  std::size_t openCorners() const { return soup_.corners.size() - (soup_.ends.empty() ? 0 : soup_.ends.back()); }

  LineReader line_;
  PolygonSoup soup_;
  Open open_ = Open::Nothing;
};

constexpr std::size_t kHeader = 84, kFacet = 50;

/// Length in bytes of a binary STL that begins as `text` does.
std::size_t binarySize(std::string_view text) {
  std::uint32_t facets = 0;
  if (text.size() >= kHeader) std::memcpy(&facets, text.data() + kHeader - sizeof facets, sizeof facets);
  return kHeader + kFacet * std::size_t{facets};
}

/// Headers of binary files may begin with "solid" too. A binary file has zeros after it, at the latest in the count of
/// triangles.
bool isTextStl(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n\v\f");
  if (first == std::string_view::npos || text.substr(0, kHeader).find('\0') != std::string_view::npos) return false;
  return lowered(text.substr(first, 5)) == "solid";
}

}  // namespace

Result<StlPolygons> readStl(const std::string& file, std::string_view text) {
  const std::size_t needed = binarySize(text);
  if (text.size() == needed) return StlPolygons();
  if (isTextStl(text)) {
    Result<PolygonSoup> soup = TextStl(file, text).read();
    if (!soup) return soup.error();
    return StlPolygons(std::move(soup).value());
  }
  const bool isShort = text.size() < needed;
  return Error{
      fmt::format("{}: {} bytes are too {} for a binary STL of {} triangles ({} bytes), and a text one begins with "
                  "'solid'; it is {} or not STL, export it again",
                  file, text.size(), isShort ? "few" : "many", (needed - kHeader) / kFacet, needed,
                  isShort ? "truncated" : "miscounted")};
}

}  // namespace cairn::builder
