// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn::wasm {

/// The tree without what is below `depth` levels. Its leaves are nodes that cover the surface as well, with larger
/// certified errors: contacts get coarser and cheaper. Fails for no level.
Result<SphereTree> cutBelow(const SphereTree& tree, int depth);

/// Depth, nodes, leaves, levels with meshes, bytes, volume, centre of mass (3), inertia per kilogram (9).
std::vector<double> numbersOf(const SphereTree& tree);
/// Vertices of the source mesh in its own frame, three numbers each.
std::vector<float> meshVertices(const SphereTree& tree);
/// Its triangles, three indices each.
std::vector<std::uint32_t> meshTriangles(const SphereTree& tree);
/// The spheres of a level, and leaves above it: centre (3, mesh frame), radius, certified error.
std::vector<float> spheresOf(const SphereTree& tree, std::uint32_t level);

}  // namespace cairn::wasm
