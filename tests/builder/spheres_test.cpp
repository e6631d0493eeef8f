// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "balls/ball_fit.h"
#include "balls/depth_field.h"
#include "balls/enclosing_ball.h"
#include "builder_meshes.h"
#include "certify/protrusion.h"
#include "cover/divide.h"
#include "cover/optimise.h"
#include "spheres/expand.h"
#include "spheres/merge.h"
#include "spheres/octants.h"

namespace cairn::builder::spheres_test {
namespace {

// Areas and distances of meshes of size 1 are sums of some thousand terms, each rounded by 2^-53 of its size.
constexpr double kRounding = 1e-12;

/// A solid with its pieces and a list of candidate balls on a grid inside.
struct Fixture {
  explicit Fixture(TriangleMesh m, std::size_t pieceCount = 800) : mesh(std::move(m)), solid(mesh), depth(solid) {
    pieces = piecesOf(mesh);
    refinePieces(pieces, pieceCount);
    points = PointSet(cornersOf(pieces));
    const Bounds bounds = boundsOf(mesh);
    const Vec3d extent = bounds.upper - bounds.lower;
    constexpr int kCells = 9;
    for (int i = 0; i < kCells * kCells * kCells; ++i) {
      const Vec3d part((i % kCells + 0.5) / kCells, (i / kCells % kCells + 0.5) / kCells,
                       (i / kCells / kCells + 0.5) / kCells);
      const Vec3d center = bounds.lower + Vec3d(part.x * extent.x, part.y * extent.y, part.z * extent.z);
      const double s = solid.depth(center);
      if (s > 0) candidates.push_back({center, s, s});
    }
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  Pieces pieces;
  PointSet points;
  std::vector<Ball> candidates;
};

std::vector<TriangleMesh> solids() {
  return {test::meshOf(test::cuboid({1, 1, 1}, 2)), test::lumpyBall(2, 3), test::torus(1, 0.3, 24, 12)};
}

double totalArea(const Pieces& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double a, const Piece& p) { return a + areaOf(p); });
}

/// Area by source triangle.
std::vector<double> areas(const std::vector<Pieces>& parts, std::size_t triangles) {
  std::vector<double> sum(triangles, 0);
  for (const Pieces& part : parts)
    for (const Piece& piece : part) sum[piece.source] += areaOf(piece);
  return sum;
}

void expectCovers(const PointSet& points, const SphereSet& set, double slack) {
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_TRUE(std::ranges::any_of(
        set, [&](const Ball& ball) { return distance(ball.center, points[p]) <= ball.radius + slack; }))
        << "point " << p;
}

TEST(Piece, Refinement_KeepsTheAreaOfEveryTriangle) {
  for (const TriangleMesh& mesh : solids()) {
    const Pieces whole = piecesOf(mesh);
    Pieces fine = whole;
    refinePieces(fine, 3000);
    EXPECT_EQ(fine.size(), 3000U);
    const std::vector<double> before = areas({whole}, mesh.triangles.size());
    const std::vector<double> after = areas({fine}, mesh.triangles.size());
    for (std::size_t t = 0; t < before.size(); ++t) EXPECT_NEAR(before[t], after[t], kRounding);
  }
}

TEST(PointSet, Farthest_MatchesExhaustiveSearch) {
  std::mt19937_64 engine(11);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec3d> points(1 + engine() % 40);
    for (Vec3d& p : points) p = test::randomPoint(engine);
    const Vec3d center = test::randomPoint(engine);
    std::size_t expected = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (lengthSq(points[i] - center) > lengthSq(points[expected] - center)) expected = i;
    const PointSet::Farthest farthest = PointSet(points).farthest(center);
    EXPECT_EQ(farthest.index, expected);
    EXPECT_DOUBLE_EQ(farthest.distance, distance(points[expected], center));
  }
}

TEST(BallFit, APointAloneOrSeveralTimes_IsABallOfNoRadius) {
  const Fixture f(test::lumpyBall(1, 4));
  for (const int times : {1, 3}) {
    PointSet points;
    for (int i = 0; i < times; ++i) points.push(f.points[0]);
    const Ball ball = fitBall(points[0], points, f.depth);
    EXPECT_EQ(ball.radius, 0);
    EXPECT_EQ(ball.center, points[0]);
  }
}

TEST(BallFit, Descent_IsNeverWorseAndAsGoodAsAGridSearch) {
  const Fixture f(test::lumpyBall(2, 4));
  PointSet cap;
  for (std::size_t p = 0; p < f.points.size(); ++p)
    if (f.points[p].z > 0.4) cap.push(f.points[p]);
  const Ball start = ballAround({0, 0, 0}, cap, f.depth);
  const Ball fitted = fitBall(start.center, cap, f.depth);
  EXPECT_LE(fitted.standOff(), start.standOff());
  double best = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 25;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Vec3d c =
        Vec3d(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps) * (1.2 / (kSteps - 1)) + Vec3d(-0.6, -0.6, -0.2);
    best = std::min(best, ballAround(c, cap, f.depth).standOff());
  }
  // The grid's spacing is 0.05 and the stand-off changes at most twice as fast as the centre: the best cell's optimum
  // is at most one spacing better than its best corner. A local search has to find the basin, not more.
  EXPECT_LE(fitted.standOff(), best + 0.05);
}

TEST(Expand, AnyCount_CoversItsPointsWithNoMoreThanAsked) {
  for (const TriangleMesh& mesh : solids()) {
    const Fixture f(mesh, 280);  // few enough points that the selection sees them all
    ASSERT_LE(f.points.size(), 300U);
    for (const std::size_t count : {1, 2, 5, 8}) {
      const SphereSet set = expand({f.points, f.depth, count}, f.candidates);
      EXPECT_LE(set.size(), count);
      expectCovers(f.points, set, kRounding);
    }
  }
}

TEST(Expand, MoreSpheres_NeedNoLargerStandOff) {
  const Fixture f(test::torus(1, 0.3, 24, 12), 280);
  double last = std::numeric_limits<double>::infinity();
  for (const std::size_t count : {1, 2, 4, 8}) {
    const double standOff = coverStandOff(f.points, expand({f.points, f.depth, count}, f.candidates));
    EXPECT_LT(standOff, last);
    last = standOff;
  }
}

TEST(Merge, AnyCount_CoversItsPointsWithExactlyAsMany) {
  for (const TriangleMesh& mesh : solids()) {
    const Fixture f(mesh, 400);
    for (const std::size_t count : {1, 2, 5, 8}) {
      const SphereSet set = merge({f.points, f.depth, count}, f.candidates);
      EXPECT_EQ(set.size(), count);
      expectCovers(f.points, set, kRounding);
    }
  }
}

TEST(Merge, OneSphere_IsNoWorseThanTheSmallestEnclosingBall) {
  const Fixture f(test::lumpyBall(2, 6), 400);
  const SphereSet set = merge({f.points, f.depth, 1}, f.candidates);
  const EnclosingBall smallest = smallestEnclosingBall(cornersOf(f.pieces));
  EXPECT_LE(set[0].standOff(), smallest.radius - f.solid.depth(smallest.center) + kRounding);
}

TEST(Optimise, AnyStart_CoversAndIsNeverWorse) {
  for (const TriangleMesh& mesh : solids()) {
    const Fixture f(mesh);
    const CoverProblem problem{f.points, f.depth, 8};
    for (const SphereSet& start : {expand(problem, f.candidates), merge(problem, f.candidates)}) {
      const SphereSet set = optimise(problem, start);
      EXPECT_LE(set.size(), problem.count);
      expectCovers(f.points, set, kRounding);
      EXPECT_LE(coverStandOff(f.points, set), coverStandOff(f.points, start));
      EXPECT_LE(coverStandOff(f.points, optimiseBySwaps(problem, set, 1)), coverStandOff(f.points, set));
    }
  }
}

TEST(Optimise, EightBallsOnACube_ReachTheOctants) {
  const Fixture f(test::meshOf(test::cuboid({1, 1, 1}, 2)), 2000);
  const CoverProblem problem{f.points, f.depth, 8};
  const SphereSet set = optimiseBySwaps(problem, expand(problem, f.candidates), 6);
  // One ball per corner, centred on the diagonal at a from the corner's faces, reaching the middle of the faces: the
  // stand-off is max(sqrt(3) a, sqrt(2 (1/2 - a)^2 + a^2)) - a, least where both are equal, at a = 1/4: (sqrt(3) - 1)
  // / 4.
  const double octants = 0.25 * (std::sqrt(3.0) - 1);
  EXPECT_LE(coverStandOff(f.points, set), 1.05 * octants);
}

TEST(Divide, Parts_AreHeldAndCoverEveryTriangle) {
  constexpr double kFinest = 0.01;
  for (const TriangleMesh& mesh : solids()) {
    const Fixture f(mesh);
    const SphereSet set = optimise({f.points, f.depth, 8}, {});
    const double standOff = 1.02 * coverStandOff(f.points, set);
    for (const double firstBias : {0.0, 0.3 * standOff}) {
      std::vector<double> bias(set.size(), 0);
      bias[0] = firstBias;
      const std::vector<Pieces> parts = divide(f.pieces, set, bias, standOff, kFinest);
      const std::vector<double> got = areas(parts, mesh.triangles.size());
      const std::vector<double> want = areas({f.pieces}, mesh.triangles.size());
      for (std::size_t t = 0; t < want.size(); ++t) EXPECT_NEAR(got[t], want[t], kRounding);
      for (std::size_t i = 0; i < parts.size(); ++i)
        for (const Piece& piece : parts[i]) {
          if (costOf(set[i], piece) <= standOff) continue;
          // Held by none: as small as allowed, and with the ball that has to grow least.
          EXPECT_LE(longestEdgeSq(piece), kFinest * kFinest);
          for (const Ball& other : set) EXPECT_LE(costOf(set[i], piece), costOf(other, piece));
        }
    }
  }
}

TEST(Divide, Bias_MovesSurfaceAway) {
  const Fixture f(test::meshOf(test::cuboid({4, 1, 1}, 4)));
  const SphereSet set = optimise({f.points, f.depth, 4}, {});
  const double standOff = 1.2 * coverStandOff(f.points, set);
  std::vector<double> bias(set.size(), 0);
  const double before = totalArea(divide(f.pieces, set, bias, standOff, 0.02)[0]);
  bias[0] = 0.5 * standOff;
  EXPECT_LT(totalArea(divide(f.pieces, set, bias, standOff, 0.02)[0]), before);
}

TEST(Octants, Parts_CoverEveryTriangleAndFitTheirBalls) {
  for (const TriangleMesh& mesh : solids()) {
    const Pieces pieces = piecesOf(mesh);
    constexpr double kFinest = 0.02;
    const std::vector<Octant> octants = divideByOctants(pieces, cubeAround(boundsOf(mesh)), kFinest);
    EXPECT_GE(octants.size(), 2U);
    std::vector<Pieces> parts;
    for (const Octant& octant : octants) {
      const double radius = std::sqrt(3.0) * octant.cube.halfEdge;
      for (const Piece& piece : octant.pieces)
        for (const Vec3d& corner : piece.corners) EXPECT_LE(distance(corner, octant.cube.center), radius + kFinest);
      parts.push_back(octant.pieces);
    }
    const std::vector<double> got = areas(parts, mesh.triangles.size());
    const std::vector<double> want = areas({pieces}, mesh.triangles.size());
    for (std::size_t t = 0; t < want.size(); ++t) EXPECT_NEAR(got[t], want[t], kRounding);
  }
}

TEST(ClosedDepth, BallsWithinTheScale_ProtrudeNoMoreThanItSays) {
  const Fixture f(test::torus(1, 0.3, 24, 12));
  constexpr double kScale = 0.3, kSpacing = 0.03;
  const ClosedDepth closed(f.solid, kScale, kSpacing, {0, 0, 0}, 3);
  ASSERT_TRUE(closed.usable());
  std::mt19937_64 engine(13);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3d center = test::randomPoint(engine) * 0.9;
    const double radius = closed.depth(center) + kScale;
    if (f.solid.depth(center) < -0.8 * kScale || radius <= 0) continue;
    const double protrusion = certifiedProtrusion(f.solid, center, radius, defaultProtrusionTolerance(f.solid)).upper;
    // The offset surface is known to its samples: a ball can bulge between them by their spacing, and the certificate
    // itself is 1 % wide.
    EXPECT_LE(protrusion, 1.01 * kScale + kSpacing);
    EXPECT_GE(closed.depth(center), f.solid.depth(center) - kRounding);
  }
}

TEST(ClosedDepth, NarrowHole_CountsAsFilled) {
  // The hole of this ring is 0.2 in radius: at a scale of 0.3 its middle is no deviation at all.
  const Fixture f(test::torus(1, 0.8, 32, 24));
  const ClosedDepth closed(f.solid, 0.3, 0.03, {0, 0, 0}, 3);
  EXPECT_LT(f.solid.depth({0, 0, 0}), -0.15);
  EXPECT_GT(closed.depth({0, 0, 0}), 0);
}

}  // namespace
}  // namespace cairn::builder::spheres_test
