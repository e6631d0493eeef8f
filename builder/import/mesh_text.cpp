// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/mesh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "import/line_reader.h"
#include "import/ply_reader.h"

namespace cairn::builder {
namespace {

/// What a file turned out to hold; nothing when assimp is to read it.
using Polygons = std::optional<PolygonSoup>;

/// Three coordinates that fit a float, which is what a tree keeps.
Status readPosition(LineReader& line, PolygonSoup& soup) {
  Vec3d point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = line.nextWord();
    const std::optional<double> value = parseNumber<double>(word);
    if (word.empty()) return line.error("a vertex needs three coordinates; the file may be truncated, export it again");
    if (!value) return line.error(fmt::format("'{}' is not a coordinate; correct the line or export again", word));
    if (!std::isfinite(static_cast<float>(*value)))
      return line.error(
          fmt::format("the coordinate {} is not finite in single precision; remove the vertex or rescale "
                      "the mesh",
                      word));
    point[axis] = *value;
  }
  soup.points.push_back(point);
  return {};
}

/// A fourth number and no fifth is a weight to divide by; more are colours.
Status divideByWeight(LineReader& line, Vec3d& point) {
  const std::optional<double> weight = parseNumber<double>(line.nextWord());
  if (!weight || !line.nextWord().empty()) return {};
  for (int axis = 0; axis < 3; ++axis) point[axis] /= *weight;
  if (isFinite(Vec3(point))) return {};
  return line.error("the vertex divided by its fourth number is not finite; correct the line or export again");
}

struct ObjFaces {
  std::vector<std::int64_t> vertices;    // of all faces in turn, from 1, as written; negative ones already resolved
  std::vector<std::size_t> ends, lines;  // of each face: behind its last vertex, where it is written
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

/// Faces may name vertices that come after them, so they are resolved when all are known.
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

Result<Polygons> readObj(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  PolygonSoup soup;
  ObjFaces faces;
  while (line.nextContent()) {
    const std::string_view keyword = line.nextWord();
    if (keyword == "v") {
      if (Status s = readPosition(line, soup); !s) return s.error();
      if (Status s = divideByWeight(line, soup.points.back()); !s) return s.error();
    } else if (keyword == "f" || keyword == "fo") {  // the latter in old files
      if (Status s = readObjFace(line, static_cast<std::int64_t>(soup.points.size()), faces); !s) return s.error();
    }
  }
  if (Status s = resolve(file, faces, soup); !s) return s.error();
  return Polygons(std::move(soup));
}

Status readOffFace(LineReader& line, PolygonSoup& soup) {
  const std::string_view word = line.nextWord();
  const auto corners = parseNumber<std::uint32_t>(word);
  if (!corners || *corners < 3)
    return line.error(fmt::format("'{}' is not a number of corners, which is 3 or more; export the mesh again", word));
  for (std::uint32_t i = 0; i < *corners; ++i) {
    const std::string_view name = line.nextWord();
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

/// Whether the first word promises three coordinates at the front of a vertex' line; normals, colours and texture
/// coordinates follow them.
bool isPlainOff(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

Result<Polygons> readOff(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  if (!line.nextContent()) return line.atEnd("the file has no content; export it again");
  std::string_view word = line.nextWord();
  if (!word.ends_with("OFF")) return line.error("an OFF file begins with the word OFF; check that this is one");
  if (!isPlainOff(word)) return Polygons();
  word = line.nextWord();
  if (word == "BINARY") return line.error("binary OFF is not supported; save it as text");
  if (word.empty() && line.nextContent()) word = line.nextWord();
  const auto vertices = parseNumber<std::size_t>(word);
  const auto faces = parseNumber<std::size_t>(line.nextWord());
  if (!vertices || !faces) return line.error("the counts of vertices and faces are missing; export the mesh again");
  PolygonSoup soup;
  for (std::size_t i = 0; i < *vertices; ++i) {
    if (!line.nextContent())
      return line.atEnd(
          fmt::format("the file ends after {} of {} vertices; it is truncated, export it again", i, *vertices));
    if (Status s = readPosition(line, soup); !s) return s.error();
  }
  for (std::size_t i = 0; i < *faces; ++i) {
    if (!line.nextContent())
      return line.atEnd(fmt::format("the file ends after {} of {} faces; it is truncated, export it again", i, *faces));
    if (Status s = readOffFace(line, soup); !s) return s.error();
  }
  return Polygons(std::move(soup));
}

/// Corners since the last polygon's.
std::size_t openCorners(const PolygonSoup& soup) {
  return soup.corners.size() - (soup.ends.empty() ? 0 : soup.ends.back());
}

/// The statements of one line; `isEnded` says whether the solid begun last has ended.
Status readStlLine(LineReader& line, PolygonSoup& soup, bool& isEnded) {
  for (std::string_view word = line.nextWord(); !word.empty(); word = line.nextWord()) {
    const bool isName = word == "solid" || word == "endsolid";  // and a name follows
    if ((isName || word == "facet") && openCorners(soup) > 0)
      return line.error(
          fmt::format("'{}' comes before the 'endloop' of facet {}; export it again", word, soup.ends.size() + 1));
    if (isName || word == "facet") isEnded = word == "endsolid";
    if (isName) break;
    if (word == "vertex") {
      soup.corners.push_back(static_cast<std::uint32_t>(soup.points.size()));
      if (Status s = readPosition(line, soup); !s) return s;
    } else if (word == "endloop") {
      if (openCorners(soup) < 3)
        return line.error(
            fmt::format("a facet needs three vertices, this one has {}; export it again", openCorners(soup)));
      soup.endPolygon();
    }
  }
  return {};
}

Result<Polygons> readTextStl(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  PolygonSoup soup;
  bool isEnded = false;
  while (line.nextContent())
    if (Status s = readStlLine(line, soup, isEnded); !s) return s.error();
  if (!isEnded && soup.corners.empty())
    return line.error("no facet has been read up to here; export it with each statement on a line of its own");
  if (!isEnded)
    return line.error(fmt::format("the file ends after {} facets, without 'endsolid'; it is truncated, export it again",
                                  soup.ends.size()));
  return Polygons(std::move(soup));
}

Result<Polygons> readStl(const std::string& file, std::string_view text) {
  constexpr std::size_t kHeader = 84, kFacet = 50;
  // Binary headers may begin with "solid" too; only a text goes on with a facet.
  if (text.starts_with("solid") && text.find("facet") != std::string_view::npos) return readTextStl(file, text);
  std::uint32_t facets = 0;
  if (text.size() >= kHeader) std::memcpy(&facets, text.data() + kHeader - sizeof facets, sizeof facets);
  const std::size_t needed = kHeader + kFacet * std::size_t{facets};
  if (text.size() >= kHeader && text.size() >= needed) return Polygons();
  return Error{
      fmt::format("{}: {} bytes are too few for a binary STL of {} triangles ({} bytes); it is truncated or not "
                  "STL, export it again",
                  file, text.size(), facets, needed)};
}

Result<Polygons> readText(const std::string& extension, const std::string& file, std::string_view text) {
  if (extension == ".obj") return readObj(file, text);
  if (extension == ".off") return readOff(file, text);
  if (extension == ".stl") return readStl(file, text);
  if (extension != ".ply") return Polygons();
  Result<PolygonSoup> ply = readPly(file, text);
  if (!ply) return ply.error();
  return Polygons(std::move(ply).value());
}

}  // namespace

Result<Polygons> readMeshText(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::string file = path.filename().string();
  Result<Polygons> polygons = readText(extension, file, text);
  if (polygons && polygons.value() && polygons.value()->ends.empty())
    return Error{fmt::format("{}: it holds no triangles; export a surface mesh", file)};
  return polygons;
}

}  // namespace cairn::builder
