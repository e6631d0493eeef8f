// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// How well one level's cut (all nodes of the level and all leaves above it) fits its mesh. Lengths are fractions of
/// the mesh's bounding-box diagonal, volumes of the solid's volume. "Certified" is proved (certify.h); the rest are the
/// thesis's measures (7.1.1), sampled. A sphere's error is how far it reaches outside the solid.
struct LevelFit {
  std::uint32_t level = 0;          ///< 0 is the root
  std::uint32_t spheres = 0;        ///< in the cut
  double certifiedMaxFraction = 0;  ///< upper bound of the worst sphere's error
  double certifiedRmsFraction = 0;  ///< root mean square over the spheres (Eq. 6.1, see the errata)
  ///@{
  /// Errors from points spread over each sphere; never above the certified ones. Largest, mean, root mean square and
  /// variance over the spheres, the variance as a fraction of the diagonal squared.
  double sampledMaxFraction = 0;
  double sampledMeanFraction = 0;
  double sampledRmsFraction = 0;
  double sampledVarianceFractionSquared = 0;
  ///@}
  double uncoveredAreaFraction = 0;  ///< share of area samples outside all spheres
  ///@{
  /// Volume of the solid outside all spheres, and the standard error of that estimate. Trees cover the surface: the
  /// inside may be hollow, and a body that gets there is felt by no sphere.
  double uncoveredVolumeFraction = 0;
  double uncoveredVolumeStandardErrorFraction = 0;
  ///@}
  ///@{
  /// How deep below the surface that volume lies: the deepest sample, and root mean square over the volume.
  double uncoveredDepthMaxFraction = 0;
  double uncoveredDepthRmsFraction = 0;
  ///@}
  ///@{
  /// Volume of the spheres' union outside the solid, and the standard error of that estimate.
  double wastedVolumeFraction = 0;
  double wastedVolumeStandardErrorFraction = 0;
  ///@}
  bool coverageProven = false;   ///< as `LevelCertificate::coverageProven`
  bool reachableProven = false;  ///< as `LevelCertificate::reachableProven`
};

/// Whether the sampled measures are taken too; they cost far more than the proof.
enum class Sampling : std::uint8_t { none, full };

/// The fit of levels 1 to the deepest (of level 0 for a lone root). With `Sampling::none` the sampled measures stay 0.
/// `certificate` is what `certify` found for the same tree and mesh. The same seed gives the same bits for any number
/// of threads. Precondition: `checkMesh(mesh)`. Fails only with `kCancelled`.
Result<std::vector<LevelFit>> evaluate(const SphereTree& tree, const TriangleMesh& mesh, const Certificate& certificate,
                                       Sampling sampling, std::uint64_t seed, const ProgressCallback& progress = {});

/// The fit of a set of spheres that is no tree: level 0, and nothing proved about cover or reach. Centres and radii are
/// taken as they are. Preconditions: `checkMesh(mesh)`; `balls` not empty. Fails only with `kCancelled`. Parallel; the
/// same seed gives the same bits for any number of threads. Some milliseconds for a sphere, and two seconds.
Result<LevelFit> evaluateBalls(std::span<const Ball> balls, const TriangleMesh& mesh, std::uint64_t seed,
                               const ProgressCallback& progress = {});

}  // namespace cairn::builder
