// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// Makes a closed mesh for each level of a tree that needs fewer triangles than the source: about six for each sphere
/// of the level. Its distance to the source is certified, both ways. Edges are collapsed by the greatest distance that
/// they leave. The thesis asks for such meshes in 8.3.3: one hierarchy to collide and to draw.
///
/// `spheres`: of levels 1, 2 and so on. `origin`: of the tree frame, which the result is in. Fewer meshes than levels
/// where the source serves the deeper ones; none where it has hardly more triangles than level 1 asks for. A mesh that
/// would cut through itself is replaced by that of the next level.
///
/// Fails for a mesh with a vertex where two surfaces only touch, and with `kCancelled`. Precondition:
/// `checkMesh(mesh)`. Single thread, deterministic. About a second for 1500 triangles, half a minute for 100,000.
Result<std::vector<LevelMesh>> makeLevelMeshes(const TriangleMesh& mesh, const Vec3d& origin,
                                               std::span<const std::uint32_t> spheres,
                                               const ProgressCallback& progress = {});

/// The mesh of a level, from 1 to `tree.levelMeshCount()`, in the frame of the source.
TriangleMesh levelMeshOf(const SphereTree& tree, std::uint32_t level);

/// The source mesh as the tree keeps it, rounded to float, in its own frame.
TriangleMesh sourceMeshOf(const SphereTree& tree);

/// Proves that a level's mesh is closed, does not cut through itself, and is as near to the source as it says. One
/// sentence for the first thing that does not hold. Precondition: `checkMesh(mesh)`.
std::optional<std::string> refuteLevelMesh(const SphereTree& tree, std::uint32_t level, const TriangleMesh& mesh);

}  // namespace cairn::builder
