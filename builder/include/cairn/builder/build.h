// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/balance.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// How a region of the surface is covered by a given number of spheres. `combined`, `merge` and `expand` are improved
/// further (centres moved, divisions chosen with their children in view), `adaptive` is ours; the others are the
/// thesis's constructions as they are.
enum class Method : std::uint8_t {
  combined,     ///< per node the better of merge and expand (thesis 7.1.5)
  merge,        ///< medial spheres merged pairwise (5.3.1)
  expand,       ///< medial spheres grown to one stand-off, fewest that cover (5.3.3, max-elim)
  octree,       ///< cubes of an octree (3.1)
  expandCover,  ///< as expand, but the sphere that covers most goes first (5.3.3, max-cover)
  burst,        ///< medial spheres removed one by one, their neighbours growing (5.3.2)
  spawn,        ///< spheres of one stand-off grown from each other, without a medial axis (5.4)
  solidOctree,  ///< with cubes inside the solid, which cover no surface but fill it (3.1.2)
  grid,         ///< cells of a cubic grid, freely turned and moved (3.3)
  hybrid,       ///< the regions of grid, each with a sphere of least error instead of the smallest (7.1.5)
  hubbard,      ///< one medial axis for the whole solid, merged pairwise by neighbours (4.1 to 4.3)
  adaptive,     ///< whole levels of equal error instead of regions one by one (ours)
};

/// How a sphere set is improved before the surface is divided among its spheres (thesis 6.2).
enum class Optimiser : std::uint8_t {
  none,    ///< the set as its method leaves it
  thesis,  ///< one sphere after another, by downhill simplex (Alg. 9 and 10)
  cairn,   ///< ours: for the seams too, and divisions are chosen with their children in view
};

/// What kind of tree `buildTree` makes. Values out of range are refused by it.
struct BuildOptions {
  Method method = Method::combined;  ///< how each region is covered
  std::uint32_t branching = 8;       ///< most children of a node, 2..8
  std::uint32_t depth = 3;           ///< levels below the root, 1..8
  std::uint32_t samples = 5000;      ///< surface pieces the sphere sets are fitted to, about; 100..1e6
  std::uint64_t seed = 1;            ///< of all that is drawn at random
  std::uint32_t threads = 0;         ///< 0: one per core. The result does not depend on it.
  /// Nothing: `cairn` for the methods said to be improved further, `none` for the others. Only for methods that fit
  /// spheres region by region (`fitsRegions`).
  std::optional<Optimiser> optimiser;
  /// Spheres are dropped while this allows it; nothing: none are. Only for methods that fit spheres region by region.
  std::optional<Balance> balance;
};

/// A sphere-tree of a closed mesh with certified errors: every level covers the whole surface, reachable through every
/// ancestor, by construction, with enough to spare that `certify` can prove it again from the tree alone. Fails for
/// options out of range, for a mesh `checkMesh` refuses, and with `kCancelled`. The same mesh, options and seed give
/// the same bits for any number of threads.
Result<SphereTree> buildTree(const TriangleMesh& mesh, const BuildOptions& options,
                             const ProgressCallback& progress = {});

/// The method of a name, as `cairn build --method` takes it. Fails for any other, with the names there are.
Result<Method> parseMethod(const std::string& name);
/// The name that `parseMethod` reads.
const char* methodName(Method method);
/// Of all methods, those for general use first.
std::vector<std::string> methodNames();
/// The optimiser of a name, as `cairn build --optimise` takes it. Fails for any other, with the names there are.
Result<Optimiser> parseOptimiser(const std::string& name);
/// The name that `parseOptimiser` reads.
const char* optimiserName(Optimiser optimiser);
/// Of all optimisers.
std::vector<std::string> optimiserNames();
/// True for methods that fit a set of spheres to one region after another: they can be optimised and balanced.
bool fitsRegions(Method method);
/// True for methods that cut cubes in eight: they take no other branching.
bool dividesByEight(Method method);

}  // namespace cairn::builder
