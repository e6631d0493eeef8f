// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/flat_problem.h"

namespace cairn::builder {
namespace {

/// Points for each ball, and at least and at most in all. The `adaptive` method takes as many; at most, because a
/// table of balls times points has to fit the memory of a desk.
constexpr std::size_t kFittedPerBall = 100, kMinFitted = 1500, kMaxFitted = 60'000;
constexpr std::size_t kDensePerPoint = 8, kMaxDense = 240'000;

PointSet cornersFor(const TriangleMesh& mesh, std::size_t points) {
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, 2 * points);  // a closed surface has twice as many triangles as corners
  return PointSet(cornersOf(pieces));
}

}  // namespace

FlatPoints flatPointsOf(const TriangleMesh& mesh, std::size_t count) {
  const std::size_t points = std::clamp(kFittedPerBall * count, kMinFitted, kMaxFitted);
  // A mesh may bring more vertices than are needed.
  const PointSet fitted = evenSample(cornersFor(mesh, points), 2 * points, 0);
  return {fitted, evenSample(cornersFor(mesh, std::min(kDensePerPoint * points, kMaxDense)), kMaxDense, 0)};
}

}  // namespace cairn::builder
