// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <vector>

#include "cairn/builder/import.h"
#include "cairn/core/atomic_file.h"
#include "import/mesh_text.h"
#include "import/scene_reader.h"
#include "import/sha256.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

Status checkFinite(const std::string& file, const TriangleSoup& soup) {
  for (std::size_t t = 0; t < soup.size(); ++t) {
    for (const Vec3d& corner : soup[t]) {
      if (!isFinite(corner))
        return Error{
            fmt::format("{}: triangle {} has a coordinate that is not finite; correct it or export again", file, t)};
    }
  }
  return {};
}

}  // namespace

Result<TriangleMesh> importMesh(const std::filesystem::path& path, ImportCounts* counts) {
  const std::string file = path.filename().string();
  Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  if (bytes.value().empty()) return Error{fmt::format("{}: the file is empty; export the mesh again", path.string())};
  if (Status s = checkMeshText(path, bytes.value()); !s) return s.error();

  Result<TriangleSoup> soup = readTriangles(path);
  if (!soup) return soup.error();
  if (Status s = checkFinite(file, soup.value()); !s) return s.error();
  ImportCounts local;
  TriangleMesh mesh = weld(soup.value(), counts != nullptr ? *counts : local);
  mesh.name = file;
  mesh.sha256 = sha256Hex(bytes.value());
  if (Status s = checkMesh(mesh); !s) return s.error();
  return mesh;
}

}  // namespace cairn::builder
