// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "evaluate/sampled_protrusion.h"
#include "evaluate/uncovered_area.h"
#include "evaluate/volumes.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

LevelFit certifiedFit(const LevelCertificate& certificate, double diagonal) {
  LevelFit fit;
  fit.level = certificate.level;
  fit.spheres = certificate.spheres;
  fit.certifiedMaxFraction = certificate.maxProtrusion / diagonal;
  fit.certifiedRmsFraction = certificate.rmsProtrusion / diagonal;
  fit.coverageProven = certificate.coverageProven;
  fit.reachableProven = certificate.reachableProven;
  return fit;
}

std::vector<CutBall> cutBalls(const SphereTree& tree, std::uint32_t level) {
  std::vector<CutBall> balls;
  for (const NodeId node : tree.levelCut(level)) {
    const Sphere s = tree.sphere(node);
    balls.push_back({tree.origin() + Vec3d(s.center), s.radius});
  }
  return balls;
}

void sampleProtrusions(const SignedDistance& solid, const std::vector<CutBall>& balls, LevelFit& fit) {
  std::vector<double> errors(balls.size());
  const double diagonal = solid.bounds().diagonal();
  tbb::parallel_for(std::size_t{0}, balls.size(), [&](std::size_t i) {
    errors[i] = sampledProtrusion(solid, balls[i].center, balls[i].radius) / diagonal;
  });
  const auto count = static_cast<double>(errors.size());
  double sum = 0, sumSq = 0, deviationSq = 0;
  for (const double error : errors) sum += error, sumSq += error * error;
  for (const double error : errors) deviationSq += (error - sum / count) * (error - sum / count);
  fit.sampledMaxFraction = *std::max_element(errors.begin(), errors.end());
  fit.sampledRmsFraction = std::sqrt(sumSq / count);
  fit.sampledVarianceFractionSquared = deviationSq / count;
}

/// Each integral has a stream of random numbers of its own and runs in one thread.
void measureVolumes(const SignedDistance& distance, const SolidLines& solid, double volume, const BallLines& balls,
                    std::uint64_t seed, LevelFit& fit) {
  VolumeEstimate wasted, uncovered;
  UncoveredDepth depth;
  tbb::parallel_invoke([&] { wasted = wastedVolume(solid, balls, seed); },
                       [&] { uncovered = uncoveredVolume(solid, balls, seed); },
                       [&] { depth = uncoveredDepth(distance, solid, balls, seed); });
  fit.wastedVolumeFraction = wasted.value / volume;
  fit.wastedVolumeStandardErrorFraction = wasted.standardError / volume;
  fit.uncoveredVolumeFraction = uncovered.value / volume;
  fit.uncoveredVolumeStandardErrorFraction = uncovered.standardError / volume;
  const double diagonal = distance.bounds().diagonal();
  fit.uncoveredDepthMaxFraction = depth.max / diagonal;
  fit.uncoveredDepthRmsFraction = depth.rms / diagonal;
}

}  // namespace

Result<std::vector<LevelFit>> evaluate(const SphereTree& tree, const TriangleMesh& mesh, const Certificate& certificate,
                                       Sampling sampling, std::uint64_t seed, const ProgressCallback& progress) {
  assert(certificate.levels.size() == tree.depth() + 1);
  const double diagonal = boundsOf(mesh).diagonal();
  const std::uint32_t first = std::min(tree.depth(), 1U);
  std::vector<LevelFit> fits;
  for (std::uint32_t level = first; level <= tree.depth(); ++level)
    fits.push_back(certifiedFit(certificate.levels[level], diagonal));
  if (sampling == Sampling::none) return fits;

  const SignedDistance solid(mesh);
  const SolidLines lines(mesh);
  const double volume = massPropertiesOf(mesh).volume;
  for (LevelFit& fit : fits) {
    const auto index = static_cast<double>(fit.level - first);
    const std::vector<CutBall> balls = cutBalls(tree, fit.level);
    const double steps = 3 * static_cast<double>(fits.size());
    const auto report = [&](double step) {
      return !progress || progress("sampling the fit", (3 * index + step) / steps);
    };
    if (!report(0)) return Error{std::string(kCancelled)};
    sampleProtrusions(solid, balls, fit);
    if (!report(1)) return Error{std::string(kCancelled)};
    fit.uncoveredAreaFraction = uncoveredAreaFraction(mesh, balls, seed);
    if (!report(2)) return Error{std::string(kCancelled)};
    measureVolumes(solid, lines, volume, BallLines(balls), seed, fit);
  }
  return fits;
}

}  // namespace cairn::builder
