// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/solid_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cairn/builder/repair.h"
#include "certify/left_out.h"
#include "robot/placing.h"

namespace cairn::builder {
namespace {

std::vector<double> errorsOf(const BallsCertificate& proof) {
  std::vector<double> errors;
  for (const BallProof& ball : proof.balls) errors.push_back(ball.protrusion.upper);
  return errors;
}

EnclosedDistance namedLeftOut(const SolidCover& cover, const RobotSolid& solid, const ProgressCallback& progress) {
  // Finer than a repair moves vertices, so that what it left out can be told from a hole.
  const LeftOutTolerance tolerance{0.01, 0.1 * kStitchTolerance * boundsOf(solid.surface).diagonal()};
  return surfaceLeftOut(cover.balls, solid.surface, tolerance, [&] { return !progress || progress("certifying", 0); });
}

Status certify(const RobotSolid& solid, const ProgressCallback& progress, SolidCover& cover) {
  const Result<BallsCertificate> proof = certifyBalls(cover.balls, solid.solid, progress);
  if (!proof) return proof.error();
  cover.errors = errorsOf(proof.value());
  cover.sticksOut = proof.value().sticksOut.upper;
  cover.leavesOut = proof.value().leavesSurface.upper;
  cover.covered = cover.leavesOut == 0;
  return {};
}

/// How far balls may grow to cover what was named. A skin encloses it at its distance; triangles deep inside, where
/// bodies of a file overlap, are not worth more. A repair moves faces by about the weld and rounds to floats.
double mostGrowth(const RobotSolid& solid) {
  const bool isRepaired = solid.source == SolidSource::repaired;
  return isRepaired ? 2 * RepairOptions{}.weld * boundsOf(solid.solid).diagonal() : solid.offOriginal;
}

/// Lets balls of a solid that was changed grow until they cover the named surface too, if that keeps `maxError`.
Status coverNamed(const RobotSolid& solid, bool mayGrow, double maxError, const ProgressCallback& progress,
                  SolidCover& cover) {
  // More than the rounding that the proof allows for, less than any error that is shown.
  const double margin = 1e-10 * boundsOf(solid.solid).diagonal();
  double left = namedLeftOut(cover, solid, progress).upper;
  if (mayGrow && left > 0 && left <= mostGrowth(solid)) {
    SolidCover grown = cover;
    for (Ball& ball : grown.balls) ball.radius += left + margin;
    if (Status s = certify(solid, progress, grown); !s) return s;
    if (grown.sticksOut <= maxError) {
      cover = std::move(grown);
      left = namedLeftOut(cover, solid, progress).upper;
    }
  }
  if (progress && !progress("certifying", 1)) return Error{std::string(kCancelled)};
  cover.coversNamed = left == 0;
  if (!cover.covered) cover.leavesOut = left;
  return {};
}

}  // namespace

bool isCovering(Objective objective) {
  return objective == Objective::outer || objective == Objective::volume;
}

double errorOf(const SolidCover& cover, Objective objective) {
  if (objective == Objective::inner) return cover.leavesOut;
  return objective == Objective::balanced ? std::max(cover.sticksOut, cover.leavesOut) : cover.sticksOut;
}

Result<SolidCover> coverSolid(const RobotSolid& solid, const CoverWish& wish, const ProgressCallback& progress) {
  CoverOptions wanted;
  wanted.spheres = wish.spheres;
  wanted.objective = wish.objective;
  wanted.seed = wish.seed;
  wanted.quick = wish.quick;
  const double maxError = wish.maxError - solid.offOriginal;
  if (!wish.spheres) wanted.maxError = maxError;
  Result<Cover> made = coverMesh(solid.solid, wanted, progress);
  if (!made) return made.error();
  SolidCover cover;
  cover.balls = std::move(made.value().balls);
  const BallsCertificate& proof = made.value().certificate;
  cover.errors = errorsOf(proof);
  cover.sticksOut = proof.sticksOut.upper;
  cover.leavesOut = proof.leavesSurface.upper;
  cover.covered = cover.coversNamed = cover.leavesOut == 0;
  const bool changed = solid.source != SolidSource::original && solid.source != SolidSource::box;
  if (changed && !wish.quick)
    if (Status s = coverNamed(solid, isCovering(wish.objective), maxError, progress, cover); !s) return s.error();
  cover.sticksOut += solid.offOriginal;
  for (double& error : cover.errors) error += solid.offOriginal;
  return cover;
}

double placingError(const RobotPart& part, const RobotSolid& solid, const CollisionShape& shape) {
  // Radii grow by the deviation, and twice that lies between the solids (see `placeCover`). No ball of a cover is
  // farther out or larger than a few diagonals.
  const Bounds bounds = boundsOf(solid.solid);
  const double reach = sizeOf(bounds.lower) + sizeOf(bounds.upper) + sizeOf(shape.origin.translation);
  return 3 * part.deviation * (1 + 0x1p-40) + 48 * kPlacing * reach;
}

void placeCover(const SolidCover& cover, Objective objective, const CollisionShape& shape, RobotPart& part) {
  part.balls = cover.balls;
  double mostGrown = 0;
  for (Ball& ball : part.balls) {
    // There, and back when the cover is proved again (`certifyRobot`).
    const double rounding = 3 * placingRounding(ball.center, shape.origin.translation, ball.radius);
    const double grown = isCovering(objective) ? part.deviation * (1 + 0x1p-40) + rounding : 0;
    ball.center =
        shape.origin({ball.center.x * part.signs.x, ball.center.y * part.signs.y, ball.center.z * part.signs.z});
    ball.radius += grown;
    mostGrown = std::max(mostGrown, grown + rounding);
  }
  // A point of the mirrored solid is within twice the deviation of the part's own: farther inside its surface than the
  // deviation it is in both, because moving the surface that far does not pass over it.
  const double more = mostGrown + 2 * part.deviation;
  part.sticksOut = cover.sticksOut + more;
  part.errors.clear();
  for (const double error : cover.errors) part.errors.push_back(error + more);
  part.covered = cover.covered;
  part.coversNamed = cover.coversNamed;
  part.leavesOut = cover.covered ? 0 : cover.leavesOut + mostGrown + part.deviation;
}

}  // namespace cairn::builder
