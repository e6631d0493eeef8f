// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flat covers: what is promised of every set, whatever it is made for.
#include "cairn/builder/cover.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <sstream>

#include "builder_meshes.h"
#include "cairn/builder/grain.h"
#include "flat/fill_up.h"
#include "flat/settle_radii.h"

namespace cairn::builder::cover_test {
namespace {

constexpr Objective kAll[] = {Objective::outer, Objective::balanced, Objective::inner, Objective::volume};

CoverOptions optionsFor(std::uint32_t spheres, Objective objective) {
  CoverOptions options;
  options.spheres = spheres;
  options.objective = objective;
  return options;
}

Cover coverOf(const TriangleMesh& mesh, const CoverOptions& options) {
  Result<Cover> cover = coverMesh(mesh, options);
  EXPECT_TRUE(cover.ok()) << cover.error().message;
  return std::move(cover).value();
}

/// The promise of the objective beside its figures.
void expectPromises(const Cover& cover, Objective objective) {
  const BallsCertificate& c = cover.certificate;
  EXPECT_EQ(c.balls.size(), cover.balls.size());
  if (objective == Objective::outer || objective == Objective::volume) EXPECT_EQ(c.leavesSurface.upper, 0);
  if (objective == Objective::inner) EXPECT_EQ(c.sticksOut.upper, 0);
  for (std::size_t i = 0; i < cover.balls.size(); ++i) {
    EXPECT_GT(cover.balls[i].radius, 0);
    EXPECT_LE(c.balls[i].protrusion.upper, c.sticksOut.upper);
    EXPECT_LE(c.balls[i].innerRadius, cover.balls[i].radius);
  }
}

class CoverCount : public testing::TestWithParam<std::tuple<std::uint32_t, Objective>> {};

TEST_P(CoverCount, IsExact) {
  const auto [spheres, objective] = GetParam();
  const TriangleMesh mesh = spheres > 20 ? test::meshOf(test::cuboid({1, 0.8, 0.5}, 1)) : test::lumpyBall(2, 3);
  const Cover cover = coverOf(mesh, optionsFor(spheres, objective));
  EXPECT_EQ(cover.balls.size(), spheres);
  expectPromises(cover, objective);
}

INSTANTIATE_TEST_SUITE_P(Cells, CoverCount,
                         testing::Combine(testing::Values(1U, 4U, 8U, 20U, 64U), testing::ValuesIn(kAll)));

TEST(Cover, IsFilledUpWhereMoreSpheresHaveNothingToLower) {
  const TriangleMesh mesh = test::torus(1, 0.3, 12, 8);
  const SignedDistance solid(mesh);
  const PointSet points(mesh.vertices);
  const SphereSet set = filledUp({Ball{{1, 0, 0}, 2, 0}}, 40, points, solid);
  ASSERT_EQ(set.size(), 40U);
  for (std::size_t i = 1; i < set.size(); ++i) {
    EXPECT_GT(set[i].radius, 0);
    EXPECT_LE(set[i].radius, solid.depth(set[i].center));
    for (std::size_t k = 1; k < i; ++k) EXPECT_NE(set[i].center, set[k].center);
  }
}

TEST(Cover, BalancedIsAsGoodAsAShrunkOuterSet) {
  // Any outer set of error e becomes a balanced one of about e / 2: what is made for the objective has to be as good.
  const TriangleMesh mesh = test::lumpyBall(2, 5);
  const double outer = coverOf(mesh, optionsFor(8, Objective::outer)).error(Objective::outer);
  const double balanced = coverOf(mesh, optionsFor(8, Objective::balanced)).error(Objective::balanced);
  EXPECT_LE(balanced, 0.6 * outer);
  // Grown by its error a balanced set covers, so it cannot be much better than half either.
  EXPECT_GE(balanced, 0.4 * outer);
}

TEST(Cover, FewestSpheresKeepTheError) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 0.8, 0.5}, 1));
  const double diagonal = boundsOf(mesh).diagonal();
  CoverOptions options;
  options.spheres.reset();
  options.maxError = 0.12 * diagonal;
  const Cover cover = coverOf(mesh, options);
  EXPECT_LE(cover.error(Objective::outer), *options.maxError);
  ASSERT_GT(cover.balls.size(), 1U);
  const auto fewer = static_cast<std::uint32_t>(cover.balls.size() - 1);
  EXPECT_GT(coverOf(mesh, optionsFor(fewer, Objective::outer)).error(Objective::outer), *options.maxError);
}

TEST(Cover, DoesNotDependOnTheNumberOfThreads) {
  const TriangleMesh mesh = test::lumpyBall(2, 7);
  for (const Objective objective : kAll) {
    std::string texts[2];
    for (const std::size_t threads : {1, 3}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      texts[threads / 2] = coverText(coverOf(mesh, optionsFor(6, objective)));
    }
    EXPECT_EQ(texts[0], texts[1]) << objectiveName(objective);
  }
}

TEST(Cover, SymmetricSetsAreTheirOwnMirrorImages) {
  const TriangleMesh mesh = test::moved(test::torus(1, 0.3, 16, 8), [](const Vec3d& v) {
    return Vec3d{2 * v.x + 0.3 * std::abs(v.y), v.y, v.z};  // mirrored at y = 0 and z = 0, no longer at x = 0
  });
  for (const Objective objective : {Objective::outer, Objective::balanced, Objective::inner}) {
    for (const std::uint32_t spheres : {6U, 7U}) {
      CoverOptions options = optionsFor(spheres, objective);
      options.symmetric = true;
      const Cover cover = coverOf(mesh, options);
      EXPECT_EQ(cover.balls.size(), spheres);
      expectPromises(cover, objective);
      ASSERT_TRUE(cover.mirror.has_value());
      const MirrorPlane& plane = *cover.mirror;
      for (const Ball& ball : cover.balls) {
        const Vec3d image = ball.center - plane.normal * (2 * (dot(plane.normal, ball.center) - plane.offset));
        EXPECT_TRUE(std::any_of(cover.balls.begin(), cover.balls.end(), [&](const Ball& other) {
          return distance(other.center, image) < 1e-9 && std::abs(other.radius - ball.radius) < 1e-9;
        })) << objectiveName(objective);
      }
    }
  }
}

TEST(Cover, RefusesWithASentence) {
  const TriangleMesh lumpy = test::lumpyBall(2, 1);
  CoverOptions symmetric = optionsFor(4, Objective::outer);
  symmetric.symmetric = true;
  CoverOptions both = optionsFor(4, Objective::outer), neither = both, volume = symmetric, many = both;
  both.maxError = 1;
  neither.spheres.reset();
  volume.objective = Objective::volume;
  many.spheres = kMaxCoverSpheres + 1;
  CoverOptions nan = neither, none = neither;
  nan.maxError = std::nan("");
  none.maxError = 0;
  for (const auto& [options, part] :
       {std::pair{symmetric, "mirrors"}, std::pair{both, "one of the two"}, std::pair{neither, "one of the two"},
        std::pair{volume, "volume"}, std::pair{many, "4097"}, std::pair{nan, "nan"}, std::pair{none, "above 0"}}) {
    const Result<Cover> cover = coverMesh(lumpy, options);
    ASSERT_FALSE(cover.ok()) << part;
    EXPECT_NE(cover.error().message.find(part), std::string::npos) << cover.error().message;
  }
  TriangleMesh open = lumpy;
  open.triangles.pop_back();
  EXPECT_FALSE(coverMesh(open, optionsFor(4, Objective::outer)).ok());
}

TEST(Cover, IsCancelledAtAnyReport) {
  const TriangleMesh mesh = test::lumpyBall(2, 1);
  for (const int after : {0, 5, 50, 200}) {
    std::atomic<int> left = after;
    const Result<Cover> cover =
        coverMesh(mesh, optionsFor(8, Objective::volume), [&](std::string_view, double) { return left-- > 0; });
    ASSERT_FALSE(cover.ok()) << after;
    EXPECT_EQ(cover.error().message, kCancelled);
  }
}

TEST(MirrorPlane, IsFoundAndItsDeviationIsProved) {
  const auto tilt = [](const Vec3d& v) { return Vec3d{0.6 * v.x - 0.8 * v.y + 3, 0.8 * v.x + 0.6 * v.y, v.z - 2}; };
  const TriangleMesh mesh = test::moved(test::moved(test::torus(1, 0.3, 16, 8),
                                                    [](const Vec3d& v) {
                                                      return Vec3d{v.x, 1.5 * v.y, 1.2 * v.z};
                                                    }),
                                        tilt);
  const auto plane = mirrorPlaneOf(mesh);
  ASSERT_TRUE(plane.has_value());
  // The mesh is symmetric to rounding; the proof encloses distances to 1e-4 of the box diagonal, which is below 5.
  EXPECT_LE(plane->deviation, 5e-4);
  EXPECT_NEAR(length(plane->normal), 1, 1e-12);
  EXPECT_FALSE(mirrorPlaneOf(test::lumpyBall(2, 1)).has_value());
}

TEST(CoverText, RoundTripsEveryBit) {
  const TriangleMesh mesh = test::lumpyBall(2, 9);
  const Cover cover = coverOf(mesh, optionsFor(4, Objective::outer));
  std::istringstream in(coverText(cover));
  for (std::size_t i = 0; i < cover.balls.size(); ++i) {
    double x = 0, y = 0, z = 0, r = 0, error = 0, inner = 0;
    ASSERT_TRUE(in >> x >> y >> z >> r >> error >> inner);
    EXPECT_EQ(Vec3d(x, y, z), cover.balls[i].center);
    EXPECT_EQ(r, cover.balls[i].radius);
    EXPECT_EQ(error, cover.certificate.balls[i].protrusion.upper);
    EXPECT_EQ(inner, cover.certificate.balls[i].innerRadius);
  }
  std::string more;
  EXPECT_FALSE(in >> more);
}

}  // namespace
}  // namespace cairn::builder::cover_test
