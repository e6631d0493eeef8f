// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "evaluate/sampled_protrusion.h"
#include "evaluate/sphere_union.h"
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
  tbb::parallel_for(std::size_t{0}, balls.size(),
                    [&](std::size_t i) { errors[i] = sampledProtrusion(solid, balls[i].center, balls[i].radius); });
  double sumSq = 0;
  for (const double error : errors) sumSq += error * error;
  const double diagonal = solid.bounds().diagonal();
  fit.sampledMaxFraction = *std::max_element(errors.begin(), errors.end()) / diagonal;
  fit.sampledRmsFraction = std::sqrt(sumSq / static_cast<double>(errors.size())) / diagonal;
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
    fit.wastedVolumeFraction = wastedVolume(solid, balls, seed) / volume;
  }
  return fits;
}

}  // namespace cairn::builder
