// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/settle_radii.h"

#include <algorithm>
#include <cmath>

#include "cover/divide.h"

namespace cairn::builder {
namespace {

/// Pieces the surface is divided into at least, for each ball.
constexpr std::size_t kPiecesPerBall = 100;
/// What radii have to spare over the largest coordinate: 16 times the proof's guard (certify/ball_distances.cpp).
constexpr double kSpare = 0x1p-41;

double largestCoordinate(const TriangleMesh& mesh, const SphereSet& balls) {
  double reach = 0;
  const auto offer = [&](const Vec3d& v) { reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  for (const Vec3d& v : mesh.vertices) offer(v);
  for (const Ball& ball : balls) offer(ball.center + Vec3d{ball.radius, ball.radius, ball.radius});
  return reach;
}

}  // namespace

SphereSet coveringRadii(SphereSet balls, const TriangleMesh& mesh, double standOff, double finest) {
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, kPiecesPerBall * balls.size());
  const std::vector<double> bias(balls.size(), 0);
  const std::vector<Pieces> parts = divide(std::move(pieces), balls, bias, standOff, finest, Cutting::whereItHelps);
  const double spare = kSpare * largestCoordinate(mesh, balls);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    double farthestSq = 0;
    for (const Piece& piece : parts[i])
      for (const Vec3d& corner : piece.corners) farthestSq = std::max(farthestSq, lengthSq(corner - balls[i].center));
    // A ball without a part of its own stays, as small as one that sticks out nowhere.
    balls[i].radius = parts[i].empty() ? std::max(spare, balls[i].depth) : std::sqrt(farthestSq) + spare;
  }
  return balls;
}

}  // namespace cairn::builder
