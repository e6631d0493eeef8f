// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/mesh_and_tree.h"

#include <fmt/format.h>

#include <cstdio>

#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"

namespace cairn::tool {

Result<MeshAndTree> readMeshAndTree(const std::string& meshPath, const std::string& treePath) {
  Result<builder::TriangleMesh> mesh = builder::importMesh(meshPath);
  if (!mesh) return mesh.error();
  Result<SphereTree> tree = loadTree(treePath);
  if (!tree) return tree.error();
  const std::string& builtFrom = tree.value().info().meshSha256;
  if (!builtFrom.empty() && builtFrom != mesh.value().sha256)
    fmt::print(stderr, "cairn: note: {} was built from a file of other content ({})\n", treePath,
               tree.value().info().meshName);
  return MeshAndTree{std::move(mesh).value(), std::move(tree).value()};
}

}  // namespace cairn::tool
