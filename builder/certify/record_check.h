// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Compares what a tree keeps for contacts with the mesh it is said to come from: the stored mesh is the given one
/// rounded to float, mass properties agree to 1e-9, normal cones hold the normals of their node's triangles, support
/// points lie in their node's ball. One sentence per failed kind, or per node. O(depth * triangles).
std::vector<std::string> recordFailures(const SphereTree& tree, const TriangleMesh& mesh);

}  // namespace cairn::builder
