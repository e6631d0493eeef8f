// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// How a region of the surface is covered by a given number of spheres.
enum class Method : std::uint8_t {
  combined,  ///< per node the better of merge and expand (thesis 7.1.5)
  merge,     ///< medial spheres merged pairwise (5.3.1)
  expand,    ///< medial spheres grown to one stand-off, fewest that cover (5.3.3, max-elim)
  octree,    ///< cubes of an octree (3.1)
  adaptive,  ///< whole levels of equal error instead of regions one by one (ours)
};

struct BuildOptions {
  Method method = Method::combined;
  std::uint32_t branching = 8;   ///< most children of a node, 2..8
  std::uint32_t depth = 3;       ///< levels below the root, 1..8
  std::uint32_t samples = 5000;  ///< surface pieces the sphere sets are fitted to, about; 100..1e6
  std::uint64_t seed = 1;
  std::uint32_t threads = 0;  ///< 0: one per core. The result does not depend on it.
};

/// A certified sphere-tree of a closed mesh: every level covers the whole surface, reachable through every ancestor, by
/// proof (see certify.h). Fails for options out of range, for a mesh `checkMesh` refuses, and with `kCancelled`. The
/// same mesh, options and seed give the same bits for any number of threads.
Result<SphereTree> buildTree(const TriangleMesh& mesh, const BuildOptions& options,
                             const ProgressCallback& progress = {});

Result<Method> parseMethod(const std::string& name);
const char* methodName(Method method);

}  // namespace cairn::builder
