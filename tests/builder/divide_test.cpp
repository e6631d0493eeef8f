// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dividing a surface among balls: what is not cut costs nothing.
#include "cover/divide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "builder_meshes.h"

namespace cairn::builder::divide_test {
namespace {

struct Division {
  std::size_t pieces = 0;
  double area = 0;
  double growth = 0;  // the most by which a ball has to exceed its depth
};

Division divided(const TriangleMesh& mesh, const SphereSet& balls, double standOff, double finest, Cutting cutting) {
  const std::vector<double> bias(balls.size(), 0);
  const auto parts = divide(piecesOf(mesh), balls, bias, standOff, finest, cutting);
  Division division;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Piece& piece : parts[i]) {
      ++division.pieces;
      division.area += areaOf(piece);
      for (const Vec3d& corner : piece.corners)
        division.growth = std::max(division.growth, distance(corner, balls[i].center) - balls[i].depth);
    }
  return division;
}

// One ball must reach the farthest corner, whatever is cut.
TEST(Divide, CutsNothingForOneBall) {
  const TriangleMesh mesh = test::lumpyBall(3, 1);
  const SphereSet ball{{{0, 0, 0}, 1, 0.1}};
  const Division whole = divided(mesh, ball, 0.01, 0.1, Cutting::whereItHelps);
  EXPECT_EQ(whole.pieces, mesh.triangles.size());
  EXPECT_GT(divided(mesh, ball, 0.01, 0.1, Cutting::always).pieces, 10 * whole.pieces);
}

TEST(Divide, GrowsBallsNoFartherForCuttingLess) {
  constexpr std::uint64_t kSeed = 4;
  std::mt19937_64 engine(kSeed);
  const TriangleMesh mesh = test::lumpyBall(3, 1);
  for (int trial = 0; trial < 20; ++trial) {
    SphereSet balls;
    for (int i = 0; i < 2 + trial % 7; ++i) {
      const Vec3d center{test::uniform(engine, -0.6, 0.6), test::uniform(engine, -0.6, 0.6),
                         test::uniform(engine, -0.6, 0.6)};
      balls.push_back({center, 1, test::uniform(engine, 0.2, 0.6)});
    }
    constexpr double kStandOff = 0.05, kFinest = 0.05;
    const Division all = divided(mesh, balls, kStandOff, kFinest, Cutting::always);
    const Division less = divided(mesh, balls, kStandOff, kFinest, Cutting::whereItHelps);
    EXPECT_LE(less.pieces, all.pieces) << "seed " << kSeed << " trial " << trial;
    EXPECT_NEAR(less.area, all.area, 1e-9 * all.area);
    // Both end at the same corner, or at seams: pieces of the finest edge go to either side.
    EXPECT_LE(less.growth, all.growth + kFinest) << "seed " << kSeed << " trial " << trial;
  }
}

}  // namespace
}  // namespace cairn::builder::divide_test
