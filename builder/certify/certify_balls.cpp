// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify_balls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "certify/left_out.h"
#include "certify/progress_watch.h"
#include "certify/protrusion.h"

namespace cairn::builder {
namespace {

/// The worst ball decides the set's figure, so it is enclosed more closely than the others:
/// `defaultProtrusionTolerance` leaves 1 % and 1e-4 of the diagonal open.
constexpr double kRelative = 0.002, kAbsoluteFraction = 1e-5;
/// Balls that may be the worst, or hide it, by the bounds of the first pass.
constexpr double kContender = 0.9;

BallProof proofOf(const Ball& ball, const SignedDistance& solid, const ProtrusionTolerance& tolerance) {
  const CertifiedProtrusion p = certifiedProtrusion(solid, ball.center, ball.radius, tolerance);
  const double inner = p.depth - solid.roundingBound(ball.center);
  return {{p.upper, p.lower, p.witness}, std::clamp(inner, 0.0, ball.radius)};
}

std::vector<BallProof> proofsOf(std::span<const Ball> balls, const SignedDistance& solid, ProgressWatch& watch) {
  std::vector<BallProof> proofs(balls.size());
  ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid);
  tbb::parallel_for(std::size_t{0}, balls.size(), [&](std::size_t i) {
    if (watch.report("certifying", 0)) proofs[i] = proofOf(balls[i], solid, tolerance);
  });
  double worst = 0;
  for (const BallProof& proof : proofs) worst = std::max(worst, proof.protrusion.lower);
  tolerance.relative = kRelative;
  tolerance.absolute = kAbsoluteFraction * solid.bounds().diagonal();
  tbb::parallel_for(std::size_t{0}, balls.size(), [&](std::size_t i) {
    if (proofs[i].protrusion.upper > kContender * worst && watch.report("certifying", 0.3))
      proofs[i] = proofOf(balls[i], solid, tolerance);
  });
  return proofs;
}

EnclosedDistance worstOf(const std::vector<BallProof>& proofs) {
  EnclosedDistance worst;
  for (const BallProof& proof : proofs) {
    worst.upper = std::max(worst.upper, proof.protrusion.upper);
    if (!(proof.protrusion.lower > worst.lower)) continue;
    worst.lower = proof.protrusion.lower;
    worst.witness = proof.protrusion.witness;
  }
  return worst;
}

}  // namespace

Result<BallsCertificate> certifyBalls(std::span<const Ball> balls, const TriangleMesh& mesh,
                                      const ProgressCallback& progress) {
  assert(!balls.empty());
  const SignedDistance solid(mesh);
  ProgressWatch watch(progress);
  BallsCertificate certificate;
  certificate.balls = proofsOf(balls, solid, watch);
  certificate.sticksOut = worstOf(certificate.balls);
  LeftOutTolerance tolerance;
  tolerance.absolute = 1e-4 * solid.bounds().diagonal();
  certificate.leavesSurface = surfaceLeftOut(balls, mesh, tolerance, [&] { return watch.report("certifying", 0.4); });
  certificate.leavesSolid =
      solidLeftOut(balls, solid, certificate.leavesSurface, tolerance, [&] { return watch.report("certifying", 0.7); });
  if (!watch.report("certifying", 1)) return Error{std::string(kCancelled)};
  return certificate;
}

}  // namespace cairn::builder
