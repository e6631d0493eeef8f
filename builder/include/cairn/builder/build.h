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

/// The construction that covers a region of the surface with a given number of spheres. `combined`, `merge` and
/// `expand` are improved further: their centres move, and divisions of the surface take the children into account.
/// `adaptive` is Cairn's own. The other methods are the thesis's constructions.
enum class Method : std::uint8_t {
  combined,     ///< per node the better of merge and expand (thesis 7.1.5)
  merge,        ///< medial spheres merged pairwise (5.3.1)
  expand,       ///< medial spheres grown to one stand-off; the fewest that cover are chosen (5.3.3, max-elim)
  octree,       ///< cubes of an octree (3.1)
  expandCover,  ///< like expand, but the sphere that covers most is chosen first (5.3.3, max-cover)
  burst,        ///< medial spheres removed one by one, while their neighbours grow (5.3.2)
  spawn,        ///< spheres of one stand-off grown from each other, without a medial axis (5.4)
  solidOctree,  ///< octree with the cubes inside the solid, which fill it but cover no surface (3.1.2)
  grid,         ///< cells of a cubic grid, freely turned and moved; then each sphere moves by itself (3.3, 6.1)
  hybrid,       ///< the regions of grid, each with the sphere of least certified error (7.1.5; see `twoSpheres`)
  hubbard,      ///< one medial axis for the whole solid, merged pairwise by neighbours (4.1 to 4.3)
  adaptive,     ///< whole levels of equal error instead of single regions (Cairn's own)
  gridVolume,   ///< the regions of grid, each with its smallest sphere (3.3, 7.1.5)
};

/// The way a sphere set is improved before the surface is divided among its spheres (thesis 6.2).
enum class Optimiser : std::uint8_t {
  none,    ///< the set stays as its method made it
  thesis,  ///< one sphere after another, by downhill simplex (Alg. 9 and 10)
  cairn,   ///< Cairn's own: also improves the seams, and divisions take the children into account
};

/// How spheres that overlap share the surface between them, once a region's spheres are chosen.
enum class SurfaceDivision : std::uint8_t {
  standOff,  ///< each part of the surface goes to the sphere that needs the least stand-off for it (Cairn's own)
  planes,    ///< planes between each two spheres, moved to give both equal shares (thesis 6.1, Alg. 8)
};

/// The tree that `buildTree` should make. `buildTree` refuses values out of range.
struct BuildOptions {
  Method method = Method::combined;  ///< construction of every sphere set
  std::uint32_t branching = 8;       ///< largest number of children of a node, 2..8
  std::uint32_t depth = 3;           ///< levels below the root, 1..8
  std::uint32_t samples = 5000;      ///< approximate number of surface pieces that sphere sets are fitted to; 100..1e6
  std::uint64_t seed = 1;            ///< of all random choices
  std::uint32_t threads = 0;         ///< 0: one per core; the result does not depend on it
  /// No value: `cairn` for `combined`, `merge`, `expand` and `adaptive`, `none` for the others. A value is allowed only
  /// for methods that fit spheres region by region (`fitsRegions`).
  std::optional<Optimiser> optimiser;
  /// The rule by which spheres are dropped; no value: none are dropped. Allowed only for methods that fit spheres
  /// region by region (`fitsRegions`).
  std::optional<Balance> balance;
  bool levelMeshes = false;  ///< also make a coarser mesh for each level, see level_meshes.h
  /// Nodes get two spheres: the smallest ball of the region, which traversals test, and the method's own, which
  /// answers. With `hybrid` these are the hybrid trees of thesis 7.1.5.
  bool twoSpheres = false;
  /// How the spheres of a region share its surface. Other values than `standOff` are allowed only for methods that fit
  /// spheres region by region, and not with the optimiser `cairn`, which moves the seams itself.
  SurfaceDivision division = SurfaceDivision::standOff;
};

/// Builds a sphere-tree of a closed mesh with certified errors. Every level covers the whole surface, by construction.
/// Every point of the surface also lies in all ancestors of the node that covers it. The balls have enough room to
/// spare that `certify` can prove the cover again from the tree alone.
///
/// Fails for options out of range, for a mesh that `checkMesh` refuses, and with `kCancelled`. The same mesh, options
/// and seed give the same bits for any number of threads.
///
///     TriangleMesh mesh = importMesh("bunny.obj").value();
///     SphereTree tree = buildTree(mesh, {.method = Method::adaptive, .depth = 4}).value();
Result<SphereTree> buildTree(const TriangleMesh& mesh, const BuildOptions& options,
                             const ProgressCallback& progress = {});

/// Returns the method of a name, as in `cairn build --method`. Fails for any other name and lists the valid ones.
Result<Method> parseMethod(const std::string& name);
/// Returns the name that `parseMethod` reads.
const char* methodName(Method method);
/// Names of all methods; those for general use come first.
std::vector<std::string> methodNames();
/// Returns the optimiser of a name, as in `cairn build --optimise`. Fails for any other name and lists the valid ones.
Result<Optimiser> parseOptimiser(const std::string& name);
/// Returns the name that `parseOptimiser` reads.
const char* optimiserName(Optimiser optimiser);
/// Names of all optimisers.
std::vector<std::string> optimiserNames();
/// Returns the division of a name, as in `cairn build --division`. Fails for any other name and lists the valid ones.
Result<SurfaceDivision> parseDivision(const std::string& name);
/// Returns the name that `parseDivision` reads.
const char* divisionName(SurfaceDivision division);
/// Names of all divisions.
std::vector<std::string> divisionNames();
/// True for methods that fit a set of spheres to one region after another. Only these methods can be optimised and
/// balanced.
bool fitsRegions(Method method);
/// True for methods that `Optimiser::cairn` improves unless the user chooses otherwise.
bool optimisedByCairn(Method method);
/// True for methods that cut cubes in eight; they accept no branching but 8.
bool dividesByEight(Method method);

}  // namespace cairn::builder
