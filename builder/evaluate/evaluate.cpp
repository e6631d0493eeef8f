// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "certify/protrusion.h"
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
  fit.sampledMeanFraction = sum / count;
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

/// A solid prepared for comparison with sets of spheres.
class Measured {
 public:
  explicit Measured(const TriangleMesh& mesh)
      : mesh_(mesh), solid_(mesh), lines_(mesh), volume_(massPropertiesOf(mesh).volume) {}

  /// Fills in the sampled measures. `report` receives the finished share; false once it returns false.
  bool sample(const std::vector<CutBall>& balls, std::uint64_t seed, LevelFit& fit,
              const std::function<bool(double)>& report) const {
    if (!report(0)) return false;
    sampleProtrusions(solid_, balls, fit);
    if (!report(1. / 3)) return false;
    fit.uncoveredAreaFraction = uncoveredAreaFraction(mesh_, balls, seed);
    if (!report(2. / 3)) return false;
    measureVolumes(solid_, lines_, volume_, BallLines(balls), seed, fit);
    return true;
  }

  LevelFit certified(std::span<const Ball> balls) const {
    std::vector<double> errors(balls.size());
    const ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid_);
    tbb::parallel_for(std::size_t{0}, balls.size(), [&](std::size_t i) {
      errors[i] = certifiedProtrusion(solid_, balls[i].center, balls[i].radius, tolerance).upper;
    });
    double sumSq = 0;
    for (const double error : errors) sumSq += error * error;
    LevelCertificate certificate;
    certificate.spheres = static_cast<std::uint32_t>(balls.size());
    certificate.maxProtrusion = *std::max_element(errors.begin(), errors.end());
    certificate.rmsProtrusion = std::sqrt(sumSq / static_cast<double>(errors.size()));
    return certifiedFit(certificate, solid_.bounds().diagonal());
  }

 private:
  const TriangleMesh& mesh_;
  SignedDistance solid_;
  SolidLines lines_;
  double volume_;
};

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

  const Measured measured(mesh);
  for (LevelFit& fit : fits) {
    const auto index = static_cast<double>(fit.level - first), levels = static_cast<double>(fits.size());
    const auto report = [&](double done) { return !progress || progress("sampling the fit", (index + done) / levels); };
    if (!measured.sample(cutBalls(tree, fit.level), seed, fit, report)) return Error{std::string(kCancelled)};
  }
  return fits;
}

Result<LevelFit> evaluateBalls(std::span<const Ball> balls, const TriangleMesh& mesh, std::uint64_t seed,
                               const ProgressCallback& progress) {
  assert(!balls.empty());
  const Measured measured(mesh);
  LevelFit fit = measured.certified(balls);
  std::vector<CutBall> cut;
  for (const Ball& ball : balls) cut.push_back({ball.center, ball.radius});
  const auto report = [&](double done) { return !progress || progress("sampling the fit", done); };
  if (!measured.sample(cut, seed, fit, report)) return Error{std::string(kCancelled)};
  return fit;
}

}  // namespace cairn::builder
