// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/certify.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// How well one level's cut (all nodes of the level and all leaves above it) fits its mesh. Lengths are fractions of
/// the mesh's bounding-box diagonal. "Certified" is proved (certify.h); "sampled" is the thesis's measure (7.1.1) and
/// never above it.
struct LevelFit {
  std::uint32_t level = 0;
  std::uint32_t spheres = 0;
  double certifiedMaxFraction = 0;   ///< worst protrusion of a sphere
  double certifiedRmsFraction = 0;   ///< root mean square over the spheres (Eq. 6.1, see the errata)
  double sampledMaxFraction = 0;     ///< worst distance of points spread over a sphere to the solid
  double sampledRmsFraction = 0;     ///< root mean square over the spheres of the worst of each
  double uncoveredAreaFraction = 0;  ///< share of area samples outside all spheres
  double wastedVolumeFraction = 0;   ///< volume of the spheres' union outside the solid over the solid's volume
  bool coverageProven = false;
  bool reachableProven = false;
};

/// Whether the sampled measures are taken too; they cost far more than the proof.
enum class Sampling : std::uint8_t { none, full };

/// The fit of levels 1 to the deepest (of level 0 for a lone root). With `Sampling::none` the sampled measures stay 0.
/// `certificate` is what `certify` found for the same tree and mesh. The same seed gives the same bits for any number
/// of threads. Precondition: `checkMesh(mesh)`. Fails only with `kCancelled`.
Result<std::vector<LevelFit>> evaluate(const SphereTree& tree, const TriangleMesh& mesh, const Certificate& certificate,
                                       Sampling sampling, std::uint64_t seed, const ProgressCallback& progress = {});

}  // namespace cairn::builder
