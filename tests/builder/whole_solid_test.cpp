// SPDX-License-Identifier: GPL-3.0-or-later
//
// Medial axes of whole solids, their reductions and the fit of what is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "builder_meshes.h"
#include "cairn/builder/evaluate.h"
#include "cairn/builder/expand_choices.h"
#include "cairn/builder/medial_axis.h"
#include "cairn/builder/reduce_balls.h"
#include "cover/grow_to_cover.h"
#include "medial/hubbard_medial.h"
#include "surface/signed_distance.h"

namespace cairn::builder::whole_solid_test {
namespace {

// Distances of solids of size 1 to 3, each rounded by 2^-53 of its size.
constexpr double kRounding = 1e-12;

// Spheres hold what they touch up to 1e-9 of a diagonal below 4.
constexpr double kTouching = 4e-9;

constexpr MedialSampling kSamplings[] = {MedialSampling::regular, MedialSampling::adaptive};
constexpr Reduction kReductions[] = {Reduction::hubbard, Reduction::merge, Reduction::burst, Reduction::expand,
                                     Reduction::expandCover};

MedialAxis axisOf(const TriangleMesh& mesh, const MedialAxisOptions& options) {
  auto axis = medialAxis(mesh, options);
  EXPECT_TRUE(axis) << axis.error().message;
  return std::move(axis).value();
}

bool holds(const std::vector<Ball>& balls, const Vec3d& point) {
  return std::ranges::any_of(balls, [&](const Ball& b) { return distance(b.center, point) <= b.radius + kTouching; });
}

TEST(WholeMedialAxis, SpheresTouchTheSurfaceAtSamples) {
  // Without symmetry: of four sites nearly in a plane a vertex is only known roughly.
  const TriangleMesh mesh = test::lumpyBall(2, 6);
  const SignedDistance solid(mesh);
  for (const MedialSampling sampling : kSamplings) {
    const MedialAxis axis = axisOf(mesh, {.sampling = sampling, .samples = 300});
    ASSERT_FALSE(axis.inside.empty());
    for (const Vec3d& sample : axis.samples) EXPECT_LE(solid.closest(sample).distance, kRounding);
    for (const Ball& ball : axis.inside) {
      EXPECT_GT(ball.depth, 0);
      double nearest = INFINITY;
      for (const Vec3d& sample : axis.samples) nearest = std::min(nearest, distance(sample, ball.center));
      // A Voronoi vertex is a quotient of determinants; in slivers it is off by far more than a distance is.
      EXPECT_NEAR(nearest, ball.radius, 1e-6) << "no sample inside, and one on it";
    }
  }
}

TEST(WholeMedialAxis, AdaptiveSpheresHoldEveryPointOfTheSurface) {
  const TriangleMesh mesh = test::lumpyBall(2, 9);
  const MedialAxis axis = axisOf(mesh, {.samples = 400, .surfacePieces = 3000});
  EXPECT_LE(axis.samples.size(), 400U);
  EXPECT_GE(axis.samples.size(), 380U) << "95 %";
  const std::vector<Ball> balls = axis.balls();
  for (const Vec3d& point : axis.surface) EXPECT_TRUE(holds(balls, point));
  double worst = 0;
  for (const Ball& ball : axis.inside) worst = std::max(worst, ball.standOff());
  for (const Ball& ball : axis.coverage) {
    EXPECT_LE(ball.depth, 0);
    EXPECT_LE(ball.standOff(), worst + kRounding) << "it ends when no coverage is worse";
  }
}

TEST(WholeMedialAxis, EndsAtTheSpheresAskedFor) {
  const TriangleMesh mesh = test::torus(1, 0.35, 24, 12);
  const MedialAxis axis = axisOf(mesh, {.samples = 2000, .spheres = 300});
  EXPECT_GE(axis.inside.size(), 300U);
  EXPECT_LT(axis.samples.size(), 1000U);
}

TEST(WholeMedialAxis, RefusesWhatIsOutOfRange) {
  const TriangleMesh mesh = test::torus(1, 0.35, 12, 8);
  EXPECT_FALSE(medialAxis(mesh, {.samples = 7}));
  EXPECT_FALSE(medialAxis(mesh, {.surfacePieces = 99}));
  const auto cancelled = medialAxis(mesh, {}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().message, kCancelled);
}

/// The inner vertices of the adaptive diagram are found again from its samples alone.
TEST(WholeMedialAxis, HubbardsSpheresFromItsSamplesAreTheInnerOnes) {
  const TriangleMesh mesh = test::lumpyBall(2, 4);
  const MedialAxis axis = axisOf(mesh, {.samples = 200});
  const SignedDistance solid(mesh);
  const HubbardMedial medial = hubbardMedialFrom(solid, axis.samples);
  EXPECT_EQ(medial.samples.size(), axis.samples.size());
  for (const ClusterSample& sample : medial.samples) EXPECT_FALSE(sample.clusters.empty());
  std::vector<double> ours, theirs;
  for (const Ball& ball : axis.inside) ours.push_back(ball.radius);
  for (const auto& sphere : medial.spheres) theirs.push_back(sphere.ball.radius);
  std::ranges::sort(ours);
  std::ranges::sort(theirs);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-6);
}

TEST(WholeReduction, HasAtMostSoManyBallsAndCoversTheWholeSurface) {
  const TriangleMesh mesh = test::torus(1, 0.35, 24, 12);
  const MedialAxis axis = axisOf(mesh, {.samples = 2000, .spheres = 200, .surfacePieces = 1000});
  Pieces fine = piecesOf(mesh);
  refinePieces(fine, 8000);
  for (const Reduction reduction : kReductions)
    for (const std::uint32_t count : {8U, 30U}) {
      const auto balls = reduceBalls(mesh, axis, {reduction, count, 1000});
      ASSERT_TRUE(balls) << balls.error().message;
      EXPECT_LE(balls.value().size(), count);
      std::size_t outside = 0;
      for (const Vec3d& point : cornersOf(fine)) outside += holds(balls.value(), point) ? 0 : 1;
      EXPECT_EQ(outside, 0U) << static_cast<int>(reduction) << ", " << count;
    }
  EXPECT_FALSE(reduceBalls(mesh, axis, {Reduction::merge, 0, 1000}));
  EXPECT_FALSE(reduceBalls(mesh, axis, {Reduction::merge, 8, 1000}, [] { return false; }));
}

TEST(GrowToCover, LeavesBallsAloneThatCoverAlready) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 2));
  SphereSet balls{{{0, 0, 0}, 0.9, 0.5}, {{0.4, 0, 0}, 0.1, 0.1}};
  const SphereSet before = balls;
  growToCover(balls, piecesOf(mesh), 0.01);
  EXPECT_EQ(balls[0].radius, before[0].radius) << "half the diagonal is 0.87";
  EXPECT_EQ(balls[1].radius, before[1].radius);
}

TEST(ExpandChoices, MoreStandOffNeverNeedsMoreThanEveryCandidate) {
  const TriangleMesh mesh = test::torus(1, 0.35, 24, 12);
  const MedialAxis axis = axisOf(mesh, {.samples = 2000, .spheres = 150, .surfacePieces = 500});
  const std::vector<Ball> candidates = axis.balls();
  for (const ExpandRank rank : {ExpandRank::maxElim, ExpandRank::maxCover}) {
    const ExpandChoices choices(axis.surface, candidates, rank);
    EXPECT_EQ(choices.ballsAt(choices.enoughForOne()), 1U);
    const std::size_t most = choices.ballsAt(choices.leastStandOff());
    EXPECT_LE(most, candidates.size());
    EXPECT_GT(most, 8U);
    const double forEight = choices.standOffFor(8);
    EXPECT_GE(forEight, choices.leastStandOff());
    EXPECT_LE(choices.standOffFor(12), forEight);
  }
}

/// A ball around a cube: the farthest of its points are those over the middles of faces.
TEST(EvaluateBalls, OfABallAroundACubeIsKnown) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 2));
  const double radius = std::sqrt(3.0) / 2 * (1 + kRounding), diagonal = std::sqrt(3.0);
  const auto fit = evaluateBalls(std::vector<Ball>{{{0, 0, 0}, radius, 0.5}}, mesh, 1);
  ASSERT_TRUE(fit) << fit.error().message;
  const double exact = (radius - 0.5) / diagonal;
  EXPECT_GE(fit.value().certifiedMaxFraction, exact - kRounding);
  EXPECT_LE(fit.value().sampledMaxFraction, exact + kRounding);
  EXPECT_EQ(fit.value().sampledMeanFraction, fit.value().sampledMaxFraction) << "of one ball";
  EXPECT_EQ(fit.value().sampledVarianceFractionSquared, 0);
  EXPECT_EQ(fit.value().uncoveredAreaFraction, 0);
  // Five standard errors: one in a million.
  EXPECT_NEAR(fit.value().wastedVolumeFraction, 4 * std::numbers::pi / 3 * radius * radius * radius - 1,
              5 * fit.value().wastedVolumeStandardErrorFraction);
}

}  // namespace
}  // namespace cairn::builder::whole_solid_test
