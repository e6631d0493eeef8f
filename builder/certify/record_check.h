// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Compares the records that a tree keeps for contacts with the mesh of its origin. The stored mesh is the given one
/// rounded to float. Mass properties agree to 1e-9. Normal cones hold the normals of their node's triangles, and
/// support points lie in their node's ball. Returns one sentence for each failed kind of record, or for each failing
/// node. O(depth * triangles).
std::vector<std::string> recordFailures(const SphereTree& tree, const TriangleMesh& mesh);

}  // namespace cairn::builder
