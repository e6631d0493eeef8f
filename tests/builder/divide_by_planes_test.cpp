// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/divide_by_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "balls/piece.h"
#include "builder_meshes.h"
#include "cover/divide.h"

namespace cairn::builder::divide_by_planes_test {
namespace {

// Areas and distances of meshes of size 1 to 3 are sums of some thousand terms, each rounded by 2^-53 of its size.
constexpr double kRounding = 1e-12;

Pieces piecesOfSolid(const TriangleMesh& mesh, std::size_t count = 1500) {
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, count);
  return pieces;
}

bool holds(const Ball& ball, const Piece& piece) {
  return std::ranges::all_of(piece.corners,
                             [&](const Vec3d& c) { return distance(c, ball.center) <= ball.radius * (1 + kRounding); });
}

double areaOfAll(const Pieces& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double a, const Piece& p) { return a + areaOf(p); });
}

/// Two balls around the ends of a round bar of radius 0.5 and length 3: the first is small, the second large.
const SphereSet kSmallAndLarge{{{-0.9, 0, 0}, 0.9, 0.5}, {{0.3, 0, 0}, 1.4, 0.5}};

TriangleMesh bar() {
  TriangleMesh mesh = test::cylinder(0.5, 3, 16);
  Bounds bounds = boundsOf(mesh);
  for (Vec3d& v : mesh.vertices) {
    v -= (bounds.lower + bounds.upper) * 0.5;
    if (bounds.upper.z - bounds.lower.z > 2) std::swap(v.x, v.z);
  }
  return mesh;
}

TEST(DivideByPlanes, AnyBalls_PartsTileTheRegionAndLieInTheirBallsWhereThoseHoldIt) {
  for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3}}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pieces pieces = piecesOfSolid(test::lumpyBall(2, seed));
    std::mt19937_64 engine(seed);
    SphereSet balls;
    for (int i = 0; i < 6; ++i) balls.push_back({test::randomPoint(engine), test::uniform(engine, 0.4, 1.3), 0});
    const std::vector<Pieces> parts = divideByPlanes(pieces, balls, 0.02);
    ASSERT_EQ(parts.size(), balls.size());
    double area = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      area += areaOfAll(parts[i]);
      for (const Piece& piece : parts[i])
        if (std::ranges::any_of(balls, [&](const Ball& ball) { return holds(ball, piece); }))
          EXPECT_TRUE(holds(balls[i], piece));
    }
    EXPECT_NEAR(area, areaOfAll(pieces), kRounding * static_cast<double>(pieces.size()));
  }
}

TEST(DivideByPlanes, EqualBallsOnABar_MeetInTheMiddle) {
  const SphereSet equal{{{-0.6, 0, 0}, 1.2, 0.5}, {{0.6, 0, 0}, 1.2, 0.5}};
  const Pieces pieces = piecesOfSolid(bar(), 4000);
  const std::vector<Pieces> parts = divideByPlanes(pieces, equal, 0.05);
  double longest = 0;
  for (const Piece& piece : pieces) longest = std::max(longest, std::sqrt(longestEdgeSq(piece)));
  // Each half has as many pieces; the seam is found to a piece's length.
  for (const Piece& piece : parts[0]) EXPECT_LT(centroidOf(piece).x, longest);
  for (const Piece& piece : parts[1]) EXPECT_GT(centroidOf(piece).x, -longest);
}

// Thesis 6.1: "the dividing plane between a pair of spheres is moved so as to get more of the shared points to be
// assigned to the smaller spheres", and regions should "divide the object as evenly as possible".
TEST(DivideByPlanes, SmallBallBesideALargeOne_GetsAsMuchOfTheSharedPiecesAsMakesBothEven) {
  const Pieces pieces = piecesOfSolid(bar(), 4000);
  std::ptrdiff_t onlySmall = 0, onlyLarge = 0, both = 0, beforeTheCircle = 0;
  const double apart = distance(kSmallAndLarge[0].center, kSmallAndLarge[1].center);
  const double circle = kSmallAndLarge[0].center.x + 0.5 * (apart + (0.9 * 0.9 - 1.4 * 1.4) / apart);
  for (const Piece& piece : pieces) {
    const bool inSmall = holds(kSmallAndLarge[0], piece), inLarge = holds(kSmallAndLarge[1], piece);
    both += inSmall && inLarge ? 1 : 0;
    onlySmall += inSmall && !inLarge ? 1 : 0;
    onlyLarge += inLarge && !inSmall ? 1 : 0;
    beforeTheCircle += inSmall && inLarge && centroidOf(piece).x < circle ? 1 : 0;
  }
  Pieces held;
  std::ranges::copy_if(pieces, std::back_inserter(held),
                       [](const Piece& p) { return holds(kSmallAndLarge[0], p) || holds(kSmallAndLarge[1], p); });
  ASSERT_GT(both, 100);
  const std::vector<Pieces> parts = divideByPlanes(held, kSmallAndLarge, 0.05);
  // By hand: of the shared pieces, the number for the small ball that leaves the least difference.
  const std::ptrdiff_t toSmall = std::clamp((onlyLarge + both - onlySmall) / 2, std::ptrdiff_t{0}, both);
  EXPECT_EQ(std::ssize(parts[0]), onlySmall + toSmall);
  EXPECT_EQ(std::ssize(parts[1]), onlyLarge + both - toSmall);
  EXPECT_GT(toSmall, beforeTheCircle);  // the plane has moved from the circle of both surfaces towards the large ball
}

TEST(DivideByPlanes, BallsThatDoNotOverlap_KeepTheirOwn) {
  const SphereSet apart{{{-1.1, 0, 0}, 0.8, 0.5}, {{1.1, 0, 0}, 0.8, 0.5}};
  const std::vector<Pieces> parts = divideByPlanes(piecesOfSolid(bar()), apart, 0.05);
  for (std::size_t i = 0; i < 2; ++i)
    for (const Piece& piece : parts[i]) EXPECT_FALSE(holds(apart[1 - i], piece));
}

}  // namespace
}  // namespace cairn::builder::divide_by_planes_test
