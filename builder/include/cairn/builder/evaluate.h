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

/// The fit of one level's cut (all nodes of the level and all leaves above it) to its mesh. Lengths are fractions of
/// the mesh's bounding-box diagonal, volumes are fractions of the solid's volume. "Certified" numbers are proved
/// (certify.h). The others are the thesis's measures (7.1.1) and are sampled. A sphere's error is the largest distance
/// from the solid to a point of the sphere. Where nodes have two spheres, these are the ones that answer.
struct LevelFit {
  std::uint32_t level = 0;          ///< 0 is the root
  std::uint32_t spheres = 0;        ///< number of spheres in the cut
  double certifiedMaxFraction = 0;  ///< upper bound of the worst sphere's error
  double certifiedRmsFraction = 0;  ///< root mean square over the spheres (Eq. 6.1; see the errata)
  /// The largest error at points spread over each sphere; never above the certified one.
  double sampledMaxFraction = 0;
  double sampledMeanFraction = 0;             ///< mean of these errors over the spheres
  double sampledRmsFraction = 0;              ///< root mean square of these errors over the spheres
  double sampledVarianceFractionSquared = 0;  ///< their variance, a fraction of the diagonal squared
  double uncoveredAreaFraction = 0;           ///< share of area samples that lie outside all spheres
  /// Volume of the solid outside all spheres. A tree covers the surface, so
  /// its inside may be hollow. No sphere detects a body in the hollow.
  double uncoveredVolumeFraction = 0;
  double uncoveredVolumeStandardErrorFraction = 0;  ///< standard error of `uncoveredVolumeFraction`
  double uncoveredDepthMaxFraction = 0;             ///< depth below the surface of the deepest uncovered sample
  double uncoveredDepthRmsFraction = 0;             ///< root mean square depth over the uncovered volume
  double wastedVolumeFraction = 0;                  ///< volume of the spheres' union outside the solid
  double wastedVolumeStandardErrorFraction = 0;     ///< standard error of `wastedVolumeFraction`
  bool coverageProven = false;                      ///< as `LevelCertificate::coverageProven`
  bool reachableProven = false;                     ///< as `LevelCertificate::reachableProven`
};

/// Selects whether the sampled measures are taken too; they cost far more than the proof.
enum class Sampling : std::uint8_t { none, full };

/// Returns the fit of levels 1 to the deepest, or of level 0 for a lone root. With `Sampling::none` the sampled
/// measures stay 0. `certificate` is the result of `certify` for the same tree and mesh. The same seed gives the same
/// bits for any number of threads. Precondition: `checkMesh(mesh)`. Fails only with `kCancelled`.
///
///     Certificate certificate = certify(tree, mesh).value();
///     std::vector<LevelFit> fits = evaluate(tree, mesh, certificate, Sampling::full, 1).value();
Result<std::vector<LevelFit>> evaluate(const SphereTree& tree, const TriangleMesh& mesh, const Certificate& certificate,
                                       Sampling sampling, std::uint64_t seed, const ProgressCallback& progress = {});

/// Returns the fit of a set of spheres without a tree, as level 0. Cover and reachability are not proved. Centres and
/// radii are taken as they are. Preconditions: `checkMesh(mesh)`; `balls` is not empty. Fails only with `kCancelled`.
/// Parallel; the same seed gives the same bits for any number of threads. Takes some milliseconds for each sphere, plus
/// two seconds.
Result<LevelFit> evaluateBalls(std::span<const Ball> balls, const TriangleMesh& mesh, std::uint64_t seed,
                               const ProgressCallback& progress = {});

}  // namespace cairn::builder
