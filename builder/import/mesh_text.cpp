// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/mesh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

#include "import/obj_reader.h"
#include "import/off_reader.h"
#include "import/ply_reader.h"
#include "import/stl_reader.h"

namespace cairn::builder {
namespace {

/// The content of a file; nothing when assimp must read it.
using Polygons = std::optional<PolygonSoup>;

Result<Polygons> asPolygons(Result<PolygonSoup> soup) {
  if (!soup) return soup.error();
  return Polygons(std::move(soup).value());
}

Result<Polygons> readText(const std::string& extension, const std::string& file, std::string_view text) {
  if (extension == ".obj") return asPolygons(readObj(file, text));
  if (extension == ".off") return readOff(file, text);
  if (extension == ".stl") return readStl(file, text);
  if (extension == ".ply") return asPolygons(readPly(file, text));
  return Polygons();
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
