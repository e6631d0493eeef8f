// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cairn/builder/import.h"
#include "cairn/builder/sha256.h"
#include "cairn/core/atomic_file.h"
#include "import/mesh_text.h"
#include "import/robot_surface.h"
#include "import/scene_reader.h"
#include "import/triangulate.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

Status checkFinite(const std::string& file, const TriangleSoup& soup) {
  for (std::size_t t = 0; t < soup.size(); ++t) {
    for (const Vec3d& corner : soup[t]) {
      if (!isFinite(Vec3(corner)))  // a tree keeps floats
        return Error{
            fmt::format("{}: triangle {} has a coordinate that is not finite in single precision; correct it "
                        "or export again",
                        file, t)};
    }
  }
  return {};
}

/// The text after a UTF-8 byte order mark, which some editors write.
std::span<const std::byte> withoutMark(std::span<const std::byte> bytes) {
  constexpr std::array kMark{std::byte{0xEF}, std::byte{0xBB}, std::byte{0xBF}};
  const bool marked = bytes.size() >= kMark.size() && std::equal(kMark.begin(), kMark.end(), bytes.begin());
  return marked ? bytes.subspan(kMark.size()) : bytes;
}

/// Coordinates are in double precision where this library reads the text, in single precision where assimp reads.
Result<TriangleSoup> readSoup(const std::filesystem::path& path, std::span<const std::byte> bytes, UpDirection up) {
  const std::span<const std::byte> text = withoutMark(bytes);
  const Result<std::optional<PolygonSoup>> polygons = readMeshText(path, text);
  if (!polygons) return polygons.error();
  if (polygons.value()) return triangulated(*polygons.value());
  // assimp's readers treat a byte order mark as a part of the first line.
  const bool marked = text.size() != bytes.size();
  return marked ? readTriangles(path, text, up) : readTriangles(path, up);
}

Result<TriangleMesh> readSurface(const std::filesystem::path& path, UpDirection up, ImportCounts* counts) {
  const std::string file = path.filename().string();
  Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  if (bytes.value().empty()) return Error{fmt::format("{}: the file is empty; export the mesh again", path.string())};
  const Result<TriangleSoup> soup = readSoup(path, bytes.value(), up);
  if (!soup) return soup.error();
  if (Status s = checkFinite(file, soup.value()); !s) return s.error();
  ImportCounts found;
  TriangleMesh mesh = weld(soup.value(), found);
  if (counts != nullptr) *counts = found;
  if (mesh.triangles.empty())
    return Error{fmt::format("{}: none of its triangles has an area; export the mesh again", file)};
  mesh.name = file;
  mesh.sha256 = sha256Hex(bytes.value());
  return mesh;
}

}  // namespace

Result<TriangleMesh> importSurface(const std::filesystem::path& path, ImportCounts* counts) {
  return readSurface(path, UpDirection::turned, counts);
}

Result<TriangleMesh> importRobotSurface(const std::filesystem::path& path) {
  return readSurface(path, UpDirection::ignored, nullptr);
}

Result<TriangleMesh> importMesh(const std::filesystem::path& path, ImportCounts* counts) {
  ImportCounts found;
  Result<TriangleMesh> mesh = importSurface(path, &found);
  if (counts != nullptr) *counts = found;
  if (!mesh) return mesh;
  if (Status s = checkMesh(mesh.value(), found.degenerateTriangles); !s) return s.error();
  return mesh;
}

}  // namespace cairn::builder
