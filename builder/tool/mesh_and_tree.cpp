// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/mesh_and_tree.h"

#include <fmt/format.h>

#include <cstdio>

#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"

namespace cairn::tool {

int refuseUnproved(const MeshAndTree& input, const std::string& treePath, const std::vector<std::string>& failures) {
  if (failures.empty()) return kDone;
  return refuse({fmt::format("{}: {} of its claims about {} failed, the first: {}", treePath, failures.size(),
                             input.mesh.name, failures.front())});
}

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
