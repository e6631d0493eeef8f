// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// A mesh and a tree that is said to bound it.
struct MeshAndTree {
  builder::TriangleMesh mesh;
  SphereTree tree;
};

/// Ends a command about a certificate: the exit code, and the first of its failures as one sentence.
int refuseUnproved(const MeshAndTree& input, const std::string& treePath, const std::vector<std::string>& failures);

/// Reads both; the error names the file. A tree built from a file of other bytes is accepted with a note on standard
/// error: the same mesh in another format is a fair question.
Result<MeshAndTree> readMeshAndTree(const std::string& mesh, const std::string& tree);

}  // namespace cairn::tool
