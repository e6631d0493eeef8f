// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_field.h"

#include <algorithm>
#include <cmath>

#include "balls/enclosing_ball.h"
#include "balls/piece.h"
#include "balls/sphere_set.h"
#include "surface/convexity.h"

namespace cairn::builder {

namespace {

/// Spacing of the samples as a fraction of the stand-off, and their largest number.
constexpr double kSpacing = 0.08, kMaxSamples = 100000;
/// Concavities up to this fraction of the stand-off are not closed, because the gain is small. Deep in a nearly round
/// body the samples of the closing are all about equally far, so each search would visit most of them.
constexpr double kNegligibleConcavity = 0.5;

double areaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (const Piece& piece : piecesOf(mesh)) area += areaOf(piece);
  return area;
}

}  // namespace

std::unique_ptr<DepthField> fieldNear(const SignedDistance& solid, double standOff) {
  if (isConvex(solid.mesh(), kNegligibleConcavity * standOff)) return std::make_unique<SolidDepth>(solid);
  const double spacing = std::max(kSpacing * standOff, std::sqrt(areaOf(solid.mesh()) / kMaxSamples));
  const EnclosingBall all = smallestEnclosingBall(solid.mesh().vertices);
  auto closed =
      std::make_unique<ClosedDepth>(solid, kClosingScale * standOff, spacing, all.center, all.radius + 2 * standOff);
  if (closed->usable()) return closed;
  return std::make_unique<SolidDepth>(solid);
}

}  // namespace cairn::builder
