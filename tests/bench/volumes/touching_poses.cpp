// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/touching_poses.h"

#include <algorithm>
#include <limits>
#include <random>

#include "balls/piece.h"
#include "random_tree.h"

namespace cairn::bench {
namespace {

using builder::Piece;
using builder::SignedDistance;
using builder::TriangleMesh;

struct BoundedPiece {
  Piece piece;
  double lower = 0;
  friend bool operator<(const BoundedPiece& a, const BoundedPiece& b) { return a.lower > b.lower; }
};

/// A point of the surface; a triangle's chance is its area's share.
Vec3d randomSurfacePoint(const TriangleMesh& mesh, std::mt19937_64& engine) {
  double area = 0;
  const builder::Pieces pieces = builder::piecesOf(mesh);
  for (const Piece& piece : pieces) area += areaOf(piece);
  double left = test::uniform(engine) * area;
  std::size_t i = 0;
  while (i + 1 < pieces.size() && left > areaOf(pieces[i])) left -= areaOf(pieces[i++]);
  double s = test::uniform(engine), t = test::uniform(engine);
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  const auto& [a, b, c] = pieces[i].corners;
  return a + (b - a) * s + (c - a) * t;
}

}  // namespace

Gap surfaceGap(const SignedDistance& solid, const TriangleMesh& mesh, const RigidMove& move, double tolerance) {
  std::vector<BoundedPiece> open;
  double upper = std::numeric_limits<double>::infinity();
  const auto add = [&](const Piece& piece) {
    const Vec3d middle = centroidOf(piece);
    double radius = 0;
    for (const Vec3d& corner : piece.corners) radius = std::max(radius, distance(corner, middle));
    const double away = -solid.depth(middle);
    upper = std::min(upper, away);
    if (away - radius >= upper) return;
    open.push_back({piece, away - radius});
    std::push_heap(open.begin(), open.end());
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    add({{move * corners[0], move * corners[1], move * corners[2]}, t});
  }
  while (!open.empty() && open.front().lower < upper - std::max(tolerance, upper / 2)) {
    std::pop_heap(open.begin(), open.end());
    const Piece piece = open.back().piece;
    open.pop_back();
    for (const Piece& half : bisect(piece)) add(half);
  }
  return {open.empty() ? upper : std::min(upper, open.front().lower), upper};
}

std::vector<RigidMove> touchingPoses(const SignedDistance& solid, std::size_t count, std::uint64_t seed,
                                     double tolerance) {
  constexpr int kMostSteps = 4000;  // of at least half a tolerance each, far more than conservative advancement takes
  std::mt19937_64 engine(seed);
  const TriangleMesh& mesh = solid.mesh();
  std::vector<RigidMove> poses;
  while (poses.size() < count) {
    RigidMove pose{test::randomRotation(engine), {}};
    const Vec3d from = randomSurfacePoint(mesh, engine), to = randomSurfacePoint(mesh, engine);
    const Vec3d along = test::randomRotation(engine).column(0);
    // At no way left the two points coincide: the bodies meet before.
    double way = 2 * solid.bounds().diagonal();
    for (int step = 0; step < kMostSteps && way > 0; ++step) {
      pose.translation = to - pose.rotation * from + along * way;
      const Gap gap = surfaceGap(solid, mesh, pose, tolerance / 8);
      if (gap.upper <= -tolerance / 4) break;
      way -= std::max(gap.lower, tolerance / 2);
    }
    poses.push_back(pose);
  }
  return poses;
}

RigidMove inverseOf(const RigidMove& move) {
  const Mat3d back = transpose(move.rotation);
  return {back, -(back * move.translation)};
}

}  // namespace cairn::bench
