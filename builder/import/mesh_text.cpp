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
#include <vector>

#include "import/line_reader.h"
#include "import/ply_check.h"

namespace cairn::builder {
namespace {

/// Three coordinates that fit a float, which is what assimp keeps.
Status checkPosition(LineReader& line) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = line.nextWord();
    const std::optional<double> value = parseNumber<double>(word);
    if (word.empty()) return line.error("a vertex needs three coordinates; the file may be truncated, export it again");
    if (!value) return line.error(fmt::format("'{}' is not a coordinate; correct the line or export again", word));
    if (!std::isfinite(static_cast<float>(*value)))
      return line.error(
          fmt::format("the coordinate {} is not finite in single precision; remove the vertex or rescale "
                      "the mesh",
                      word));
  }
  return {};
}

struct ObjFace {
  std::size_t line;
  std::vector<std::int64_t> vertices;  // from 1, as written; negative ones already resolved
};

Result<ObjFace> parseObjFace(LineReader& line, std::int64_t verticesSoFar) {
  ObjFace face{line.number(), {}};
  for (std::string_view word = line.nextWord(); !word.empty(); word = line.nextWord()) {
    const auto index = parseNumber<std::int64_t>(word.substr(0, word.find('/')));
    if (!index || *index == 0)
      return line.error(fmt::format("'{}' does not name a vertex (they count from 1); export the mesh again", word));
    face.vertices.push_back(*index < 0 ? verticesSoFar + 1 + *index : *index);
  }
  if (face.vertices.size() < 3)
    return line.error(
        fmt::format("a face needs at least three vertices, this one has {}; the file may be truncated, "
                    "export it again",
                    face.vertices.size()));
  return face;
}

Status checkObj(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  std::int64_t vertices = 0;
  std::vector<ObjFace> faces;
  while (line.nextContent()) {
    const std::string_view keyword = line.nextWord();
    if (keyword == "v") {
      if (Status s = checkPosition(line); !s) return s;
      ++vertices;
    } else if (keyword == "f") {
      Result<ObjFace> face = parseObjFace(line, vertices);
      if (!face) return face.error();
      faces.push_back(std::move(face).value());
    }
  }
  for (const ObjFace& face : faces) {
    for (const std::int64_t v : face.vertices) {
      if (v >= 1 && v <= vertices) continue;
      return Error{
          fmt::format("{}, line {}: the face names vertex {} but the file has {}; the file may be truncated, "
                      "export it again",
                      file, face.line, v, vertices)};
    }
  }
  return {};
}

Status checkOffFace(LineReader& line, std::size_t vertices) {
  const std::string_view word = line.nextWord();
  const auto corners = parseNumber<std::uint32_t>(word);
  if (!corners || *corners < 3)
    return line.error(fmt::format("'{}' is not a number of corners, which is 3 or more; export the mesh again", word));
  for (std::uint32_t i = 0; i < *corners; ++i) {
    const std::string_view name = line.nextWord();
    const auto index = parseNumber<std::size_t>(name);
    if (!index || *index >= vertices)
      return line.error(fmt::format(
          "'{}' does not name one of the {} vertices (they count from 0); export the mesh again", name, vertices));
  }
  return {};
}

Status checkOff(const std::string& file, std::string_view text) {
  LineReader line(file, text);
  if (!line.nextContent()) return line.atEnd("the file has no content; export it again");
  std::string_view word = line.nextWord();
  if (!word.ends_with("OFF")) return line.error("an OFF file begins with the word OFF; check that this is one");
  // Variants (COFF, NOFF, ...) interleave more numbers; the plain one is what the rest can check.
  if (word != "OFF") return {};
  word = line.nextWord();
  if (word == "BINARY") return line.error("binary OFF is not supported; save it as text");
  if (word.empty() && line.nextContent()) word = line.nextWord();
  const auto vertices = parseNumber<std::size_t>(word);
  const auto faces = parseNumber<std::size_t>(line.nextWord());
  if (!vertices || !faces) return line.error("the counts of vertices and faces are missing; export the mesh again");
  for (std::size_t i = 0; i < *vertices; ++i) {
    if (!line.nextContent())
      return line.atEnd(
          fmt::format("the file ends after {} of {} vertices; it is truncated, export it again", i, *vertices));
    if (Status s = checkPosition(line); !s) return s;
  }
  for (std::size_t i = 0; i < *faces; ++i) {
    if (!line.nextContent())
      return line.atEnd(fmt::format("the file ends after {} of {} faces; it is truncated, export it again", i, *faces));
    if (Status s = checkOffFace(line, *vertices); !s) return s;
  }
  return {};
}

Status checkStl(const std::string& file, std::string_view text) {
  constexpr std::size_t kHeader = 84, kFacet = 50;
  // Binary headers may begin with "solid" too; only a text goes on with a facet.
  const bool isText = text.starts_with("solid") && text.find("facet") != std::string_view::npos;
  if (isText) {
    if (text.find("endsolid") == std::string_view::npos)
      return Error{fmt::format("{}: the text does not end with 'endsolid'; it is truncated, export it again", file)};
    return {};
  }
  std::uint32_t facets = 0;
  if (text.size() >= kHeader) std::memcpy(&facets, text.data() + kHeader - sizeof facets, sizeof facets);
  const std::size_t needed = kHeader + kFacet * std::size_t{facets};
  if (text.size() >= kHeader && text.size() >= needed) return {};
  return Error{
      fmt::format("{}: {} bytes are too few for a binary STL of {} triangles ({} bytes); it is truncated or not "
                  "STL, export it again",
                  file, text.size(), facets, needed)};
}

}  // namespace

Status checkMeshText(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::string file = path.filename().string();
  if (extension == ".obj") return checkObj(file, text);
  if (extension == ".off") return checkOff(file, text);
  if (extension == ".stl") return checkStl(file, text);
  if (extension == ".ply") return checkPly(file, text);
  return {};
}

}  // namespace cairn::builder
