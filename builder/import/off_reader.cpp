// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/off_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "import/line_reader.h"
#include "import/position_line.h"

namespace cairn::builder {
namespace {

/// The content of an OFF; nothing when assimp must read it.
using OffPolygons = std::optional<PolygonSoup>;

struct OffCounts {
  std::size_t vertices = 0, faces = 0;
};

/// True when the first word announces three coordinates at the front of each vertex line. Normals, colours and texture
/// coordinates may follow them.
bool isPlainOff(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

std::string_view nextWordOnAnyLine(LineReader& line) {
  std::string_view word = line.nextWord();
  while (word.empty() && line.nextContent()) word = line.nextWord();
  return word;
}

/// The counts may share one line or have a line each. The number of edges may be missing, because no reader needs it.
Result<OffCounts> readCounts(LineReader& line) {
  const auto vertices = parseNumber<std::size_t>(nextWordOnAnyLine(line));
  const auto faces = parseNumber<std::size_t>(nextWordOnAnyLine(line));
  if (!vertices || !faces) return line.error("the counts of vertices and faces are missing; export the mesh again");
  if (!line.nextWord().empty()) return OffCounts{*vertices, *faces};
  LineReader ahead = line;
  const bool isAlone = ahead.nextContent() && parseNumber<std::size_t>(ahead.nextWord()) && ahead.nextWord().empty();
  if (isAlone) line = ahead;
  return OffCounts{*vertices, *faces};
}

Status readOffFace(LineReader& line, PolygonSoup& soup) {
  const std::string_view word = line.nextWord();
  const auto corners = parseNumber<std::uint32_t>(word);
  if (!corners || *corners < 3)
    return line.error(fmt::format("'{}' is not a number of corners, which is 3 or more; export the mesh again", word));
  for (std::uint32_t i = 0; i < *corners; ++i) {
    const std::string_view name = line.nextWord();
    if (name.empty())
      return line.error(fmt::format("the face ends after {} of {} corners, which its line has to name; export it again",
                                    i, *corners));
    const auto index = parseNumber<std::uint32_t>(name);
    if (!index || *index >= soup.points.size())
      return line.error(
          fmt::format("'{}' does not name one of the {} vertices (they count from 0); export the mesh again", name,
                      soup.points.size()));
    soup.corners.push_back(*index);
  }
  soup.endPolygon();
  return {};
}

Error endsEarly(const LineReader& line, std::size_t read, std::size_t promised, std::string_view what) {
  return line.atEnd(
      fmt::format("the file ends after {} of {} {}, one a line; it is truncated or writes several on a line, export it "
                  "again",
                  read, promised, what));
}

Result<PolygonSoup> readRecords(LineReader& line, const OffCounts& counts) {
  PolygonSoup soup;
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    if (!line.nextContent()) return endsEarly(line, i, counts.vertices, "vertices");
    const Result<Vec3d> position = readPosition(line);
    if (!position) return position.error();
    soup.points.push_back(position.value());
  }
  for (std::size_t i = 0; i < counts.faces; ++i) {
    if (!line.nextContent()) return endsEarly(line, i, counts.faces, "faces");
    if (Status s = readOffFace(line, soup); !s) return s.error();
  }
  if (line.nextContent())
    return line.error(
        fmt::format("the file goes on after the {} vertices and {} faces it promises; correct the counts or export it "
                    "again",
                    counts.vertices, counts.faces));
  return soup;
}

}  // namespace

Result<OffPolygons> readOff(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  if (!line.nextContent()) return line.atEnd("the file has no content; export it again");
  const std::string_view word = line.nextWord();
  if (!word.ends_with("OFF")) return line.error("an OFF file begins with the word OFF; check that this is one");
  if (!isPlainOff(word)) return OffPolygons();
  LineReader ahead = line;
  if (ahead.nextWord() == "BINARY") return line.error("binary OFF is not supported; save it as text");
  const Result<OffCounts> counts = readCounts(line);
  if (!counts) return counts.error();
  Result<PolygonSoup> soup = readRecords(line, counts.value());
  if (!soup) return soup.error();
  return OffPolygons(std::move(soup).value());
}

}  // namespace cairn::builder
