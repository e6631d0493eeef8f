// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// A mesh and a tree that is said to bound it.
struct MeshAndTree {
  builder::TriangleMesh mesh;
  SphereTree tree;
};

/// Reads both; the error names the file. A tree built from a file of other bytes is accepted with a note on standard
/// error: the same mesh in another format is a fair question.
Result<MeshAndTree> readMeshAndTree(const std::string& mesh, const std::string& tree);

}  // namespace cairn::tool
