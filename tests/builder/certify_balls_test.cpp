// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proofs about sets of balls, against dense samples measured by an oracle that shares no code with the proof.
#include "cairn/builder/certify_balls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "builder_meshes.h"
#include "distance_oracle.h"

namespace cairn::builder::certify_balls_test {
namespace {

/// Room for the rounding of the oracle's and the proof's distances, far below both figures' tolerance.
constexpr double kRounding = 1e-9;

class Sampler {
 public:
  Sampler(const TriangleMesh& mesh, std::uint64_t seed) : mesh_(mesh), oracle_{mesh}, random_(seed) {}

  double uniform() { return static_cast<double>(random_() >> 11) / 9007199254740992.0; }
  Vec3d inBox() {
    const Bounds b = boundsOf(mesh_);
    const Vec3d size = b.upper - b.lower;
    return b.lower + Vec3d{uniform() * size.x, uniform() * size.y, uniform() * size.z};
  }
  Vec3d onSurface() {
    const auto c = mesh_.corners(static_cast<std::uint32_t>(random_() % mesh_.triangles.size()));
    double u = uniform(), v = uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return c[0] + (c[1] - c[0]) * u + (c[2] - c[0]) * v;
  }
  Vec3d onBall(const Ball& ball) {
    for (;;) {
      const Vec3d d{2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
      if (lengthSq(d) <= 1 && lengthSq(d) > 0.01) return ball.center + normalized(d) * ball.radius;
    }
  }
  double toSolid(const Vec3d& p) const { return std::max(0.0, -oracle_.depth(p)); }
  bool inSolid(const Vec3d& p) const { return oracle_.windingNumber(p) > 0.5; }

 private:
  const TriangleMesh& mesh_;
  test::DistanceOracle oracle_;
  std::mt19937_64 random_;
};

double toUnion(const std::vector<Ball>& balls, const Vec3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ball& ball : balls) least = std::min(least, distance(p, ball.center) - ball.radius);
  return std::max(0.0, least);
}

std::vector<Ball> randomBalls(Sampler& sampler, std::size_t count, double size) {
  std::vector<Ball> balls;
  while (balls.size() < count) balls.push_back({sampler.inBox(), size * (0.2 + sampler.uniform()), 0});
  return balls;
}

/// Samples never exceed the upper bounds, and come near them; witnesses are what they are said to be.
void expectEncloses(const TriangleMesh& mesh, const std::vector<Ball>& balls, std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Sampler sampler(mesh, seed);
  const Result<BallsCertificate> result = certifyBalls(balls, mesh);
  ASSERT_TRUE(result.ok());
  const BallsCertificate& c = result.value();
  double sticksOut = 0, surface = 0, solid = 0;
  for (int n = 0; n < 1500; ++n) {
    const std::size_t i = static_cast<std::size_t>(n) % balls.size();
    const double out = sampler.toSolid(sampler.onBall(balls[i]));
    EXPECT_LE(out, c.balls[i].protrusion.upper + kRounding);
    sticksOut = std::max(sticksOut, out);
    surface = std::max(surface, toUnion(balls, sampler.onSurface()));
    const Vec3d p = sampler.inBox();
    if (sampler.inSolid(p)) solid = std::max(solid, toUnion(balls, p));
  }
  EXPECT_LE(sticksOut, c.sticksOut.upper + kRounding);
  EXPECT_LE(surface, c.leavesSurface.upper + kRounding);
  EXPECT_LE(solid, c.leavesSolid.upper + kRounding);
  for (const auto& d : {c.sticksOut, c.leavesSurface, c.leavesSolid}) {
    EXPECT_LE(d.lower, d.upper);
    EXPECT_LE(d.upper, 1.011 * d.lower + 1.1e-4 * boundsOf(mesh).diagonal());
  }
  if (c.sticksOut.lower > 0) {
    EXPECT_GE(sampler.toSolid(c.sticksOut.witness), c.sticksOut.lower - kRounding);
    EXPECT_LE(toUnion(balls, c.sticksOut.witness), kRounding);
  }
  if (c.leavesSurface.lower > 0) {
    EXPECT_GE(toUnion(balls, c.leavesSurface.witness), c.leavesSurface.lower - kRounding);
    EXPECT_LE(test::DistanceOracle{mesh}.distance(c.leavesSurface.witness), kRounding);
  }
  if (c.leavesSolid.lower > 0) {
    EXPECT_GE(toUnion(balls, c.leavesSolid.witness), c.leavesSolid.lower - kRounding);
    EXPECT_LE(sampler.toSolid(c.leavesSolid.witness), kRounding);
  }
}

TEST(CertifyBalls, EnclosesWhatDenseSamplesFind) {
  const TriangleMesh meshes[] = {test::lumpyBall(2, 3), test::torus(1, 0.3, 12, 6),
                                 test::meshOf(test::cuboid({1, 0.8, 0.5}, 1))};
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const TriangleMesh& mesh = meshes[seed % 3];
    Sampler sampler(mesh, 100 + seed);
    expectEncloses(mesh, randomBalls(sampler, 1 + seed * 2, 0.15 * boundsOf(mesh).diagonal()), seed);
  }
}

TEST(CertifyBalls, HoldsFarFromTheOriginAndAtOtherScales) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const TriangleMesh mesh = test::moved(test::torus(1, 0.3, 12, 6), [&](const Vec3d& v) {
      return v * scale + Vec3d{50, -7, 9} * scale;
    });
    Sampler sampler(mesh, 5);
    const std::vector<Ball> balls = randomBalls(sampler, 7, 0.4 * scale);
    const auto certificate = certifyBalls(balls, mesh);
    ASSERT_TRUE(certificate.ok());
    double surface = 0;
    for (int n = 0; n < 1500; ++n) surface = std::max(surface, toUnion(balls, sampler.onSurface()));
    EXPECT_LE(surface, certificate.value().leavesSurface.upper * (1 + 1e-9));
    EXPECT_GE(surface, 0.9 * certificate.value().leavesSurface.lower);
  }
}

TEST(CertifyBalls, ProvesACoverAndFindsTheLeastHole) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 0.8, 0.5}, 1));
  const Bounds bounds = boundsOf(mesh);
  const double radius = bounds.diagonal() / 2;
  const auto around = certifyBalls(std::vector{Ball{bounds.center(), radius * (1 + 1e-9), 0}}, mesh);
  ASSERT_TRUE(around.ok());
  EXPECT_EQ(around.value().leavesSurface.upper, 0);
  // Corners stand out by a billionth of the size.
  const auto holes = certifyBalls(std::vector{Ball{bounds.center(), radius * (1 - 1e-9), 0}}, mesh);
  ASSERT_TRUE(holes.ok());
  EXPECT_GT(holes.value().leavesSurface.lower, 0.9e-9 * radius);
}

TEST(CertifyBalls, TwoBallsThatMeetOnTheSurfaceCoverItTogether) {
  // Each holds one half of the box; both hold the seam with a millionth to spare.
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 0.8, 0.5}, 1));
  const Bounds b = boundsOf(mesh);
  const Vec3d size = b.upper - b.lower, quarter{size.x / 4, 0, 0};
  const double radius = std::sqrt(lengthSq(size) / 4 - size.x * size.x * 3 / 16) * (1 + 1e-6);
  const std::vector<Ball> balls{{b.center() - quarter, radius, 0}, {b.center() + quarter, radius, 0}};
  const auto certificate = certifyBalls(balls, mesh);
  ASSERT_TRUE(certificate.ok());
  EXPECT_EQ(certificate.value().leavesSurface.upper, 0);
  std::vector<Ball> apart = balls;
  for (Ball& ball : apart) ball.radius *= 1 - 1e-4;
  EXPECT_GT(certifyBalls(apart, mesh).value().leavesSurface.lower, 0);
}

TEST(CertifyBalls, IsCancelled) {
  const TriangleMesh mesh = test::lumpyBall(2, 1);
  const auto certificate =
      certifyBalls(std::vector{Ball{{0, 0, 0}, 1, 0}}, mesh, [](std::string_view, double) { return false; });
  ASSERT_FALSE(certificate.ok());
  EXPECT_EQ(certificate.error().message, kCancelled);
}

}  // namespace
}  // namespace cairn::builder::certify_balls_test
