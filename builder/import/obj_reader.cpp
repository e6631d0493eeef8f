// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/obj_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "import/line_reader.h"
#include "import/position_line.h"

namespace cairn::builder {
namespace {

/// A fourth number without a fifth is a weight to divide by; more numbers are colours.
Status divideByWeight(LineReader& line, Vec3d& point) {
  const std::optional<double> weight = parseNumber<double>(line.nextWord());
  if (!weight || !line.nextWord().empty()) return {};
  for (int axis = 0; axis < 3; ++axis) point[axis] /= *weight;
  if (isFinite(Vec3(point))) return {};
  return line.error("the vertex divided by its fourth number is not finite; correct the line or export again");
}

struct ObjFaces {
  std::vector<std::int64_t> vertices;    // of all faces in turn, from 1, as in the file; negative ones are resolved
  std::vector<std::size_t> ends, lines;  // for each face: the position after its last vertex, and its line
};

Status readObjFace(LineReader& line, std::int64_t verticesSoFar, ObjFaces& faces) {
  const std::size_t first = faces.vertices.size();
  for (std::string_view word = line.nextWord(); !word.empty(); word = line.nextWord()) {
    const auto index = parseNumber<std::int64_t>(word.substr(0, word.find('/')));
    if (!index || *index == 0)
      return line.error(fmt::format("'{}' does not name a vertex (they count from 1); export the mesh again", word));
    faces.vertices.push_back(*index < 0 ? verticesSoFar + 1 + *index : *index);
  }
  if (faces.vertices.size() < first + 3)
    return line.error(
        fmt::format("a face needs at least three vertices, this one has {}; the file may be truncated, "
                    "export it again",
                    faces.vertices.size() - first));
  faces.ends.push_back(faces.vertices.size());
  faces.lines.push_back(line.number());
  return {};
}

/// Faces may name later vertices, so they are resolved at the end.
Status resolve(const std::string& file, const ObjFaces& faces, PolygonSoup& soup) {
  const auto vertices = static_cast<std::int64_t>(soup.points.size());
  soup.corners.reserve(faces.vertices.size());
  for (std::size_t f = 0; f < faces.ends.size(); ++f) {
    while (soup.corners.size() < faces.ends[f]) {
      const std::int64_t v = faces.vertices[soup.corners.size()];
      if (v < 1 || v > vertices)
        return Error{
            fmt::format("{}, line {}: the face names vertex {} but the file has {}; the file may be truncated, "
                        "export it again",
                        file, faces.lines[f], v, vertices)};
      soup.corners.push_back(static_cast<std::uint32_t>(v - 1));
    }
    soup.endPolygon();
  }
  return {};
}

}  // namespace

Result<PolygonSoup> readObj(const std::string& file, std::string_view text) {
  LineReader line(file, text, LineReader::Continued::ByBackslash);
  PolygonSoup soup;
  ObjFaces faces;
  while (line.nextContent()) {
    const std::string_view keyword = line.nextWord();
    if (keyword == "v") {
      const Result<Vec3d> position = readPosition(line);
      if (!position) return position.error();
      soup.points.push_back(position.value());
      if (Status s = divideByWeight(line, soup.points.back()); !s) return s.error();
    } else if (keyword == "f" || keyword == "fo") {  // the latter in old files
      if (Status s = readObjFace(line, static_cast<std::int64_t>(soup.points.size()), faces); !s) return s.error();
    }
  }
  if (Status s = resolve(file, faces, soup); !s) return s.error();
  return soup;
}

}  // namespace cairn::builder
