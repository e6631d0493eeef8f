// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that leave out what cannot matter, each against looking at everything: the same bits.
#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "medial/hubbard_medial.h"
#include "spheres/farthest_sample.h"
#include "spheres/held_sets.h"
#include "spheres/hubbard.h"
#include "spheres/hubbard_error.h"
#include "spheres/nearest_ball.h"
#include "spheres/stand_off.h"

namespace cairn::builder {
namespace {

using test::randomPoint;
using test::uniform;

constexpr std::uint64_t kSeed = 20261121;

/// The columns of a `HeldSets`, as lists of flags.
using Flags = std::vector<std::vector<bool>>;

void expectSame(const HeldSets& sets, const Flags& flags, const std::vector<std::size_t>& names) {
  ASSERT_EQ(sets.size(), flags.size());
  const auto isSubset = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    for (std::size_t p = 0; p < a.size(); ++p)
      if (a[p] && !b[p]) return false;
    return true;
  };
  std::vector<bool> any(flags.empty() ? 0 : flags[0].size(), false);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    ASSERT_EQ(sets.name(i), names[i]);
    ASSERT_EQ(sets.count(i), static_cast<std::size_t>(std::count(flags[i].begin(), flags[i].end(), true)));
    const auto subsets =
        std::count_if(flags.begin(), flags.end(), [&](const auto& f) { return isSubset(f, flags[i]); });
    ASSERT_EQ(sets.subsetsOf(i), static_cast<std::size_t>(subsets));
    for (std::size_t p = 0; p < any.size(); ++p) any[p] = any[p] || flags[i][p];
  }
  ASSERT_EQ(sets.unionCount(), static_cast<std::size_t>(std::count(any.begin(), any.end(), true)));
}

void compareHeldSets(std::mt19937_64& engine) {
  const std::size_t points = 1 + engine() % 200, candidates = 1 + engine() % 40;
  const std::size_t padded = HeldSets::paddedPoints(points);
  std::vector<double> costs(candidates * padded, std::numeric_limits<double>::infinity());
  // Steps of a tenth, so that costs and stand-off are often equal.
  for (std::size_t i = 0; i < candidates; ++i)
    for (std::size_t p = 0; p < points; ++p) costs[i * padded + p] = std::floor(10 * uniform(engine)) / 10;
  const double standOff = std::floor(10 * uniform(engine)) / 10;
  HeldSets sets(costs, padded, standOff);
  Flags flags(candidates, std::vector<bool>(points));
  for (std::size_t i = 0; i < candidates; ++i)
    for (std::size_t p = 0; p < points; ++p) flags[i][p] = costs[i * padded + p] <= standOff;
  std::vector<std::size_t> names(candidates);
  std::iota(names.begin(), names.end(), std::size_t{0});
  ASSERT_NO_FATAL_FAILURE(expectSame(sets, flags, names));
  const auto leaveOut = [&](std::size_t barred) {
    for (std::size_t i = flags.size(); i-- > 0;) {
      if (names[i] != barred && std::count(flags[i].begin(), flags[i].end(), true) > 0) continue;
      flags.erase(flags.begin() + static_cast<std::ptrdiff_t>(i));
      names.erase(names.begin() + static_cast<std::ptrdiff_t>(i));
    }
  };
  const std::vector<std::size_t> barred{engine() % candidates};
  sets.drop(barred);
  leaveOut(barred[0]);
  while (!flags.empty()) {
    ASSERT_NO_FATAL_FAILURE(expectSame(sets, flags, names));
    const std::size_t i = engine() % flags.size();
    const std::vector<bool> taken = flags[i];
    sets.take(i);
    for (std::vector<bool>& f : flags)
      for (std::size_t p = 0; p < points; ++p) f[p] = f[p] && !taken[p];
    leaveOut(candidates);
  }
  ASSERT_EQ(sets.size(), 0U);
}

class FastPathsOnEveryTarget : public testing::Test {
 protected:
  void TearDown() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

template <class Check>
void onEveryTarget(const Check& check) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    SCOPED_TRACE(hwy::TargetName(target));
    std::mt19937_64 engine(kSeed);
    for (int round = 0; round < 30; ++round) ASSERT_NO_FATAL_FAILURE(check(engine)) << "seed " << kSeed;
  }
}

TEST_F(FastPathsOnEveryTarget, CountsAndSubsets_AreThoseOfFlags) {
  onEveryTarget(compareHeldSets);
}

void compareDistances(std::mt19937_64& engine) {
  std::vector<Vec3d> list(1 + engine() % 70);
  for (Vec3d& p : list) p = randomPoint(engine);
  list.push_back(list[engine() % list.size()]);  // so that some tie
  const PointSet points(list);
  const Vec3d center = randomPoint(engine);
  const double offset = uniform(engine);
  std::vector<double> measured(list.size());
  points.distances(center, offset, measured);
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    ASSERT_EQ(measured[i], distance(list[i], center) - offset) << "point " << i;
    if (lengthSq(list[i] - center) > lengthSq(list[farthest] - center)) farthest = i;
  }
  ASSERT_EQ(points.farthest(center).index, farthest);
  ASSERT_EQ(points.farthest(center).distance, distance(list[farthest], center));
}

TEST_F(FastPathsOnEveryTarget, DistancesOfPoints_AreThoseOfEachAlone) {
  onEveryTarget(compareDistances);
}

TEST(CornersOf, ListsEachPositionOnce_InOrder) {
  std::mt19937_64 engine(kSeed);
  // Coordinates of -1, -0, 0 and 1, so that most corners repeat.
  const double values[] = {-1, -0.0, 0, 1};
  const auto corner = [&] { return Vec3d{values[engine() % 4], values[engine() % 4], values[engine() % 4]}; };
  for (std::size_t count = 0; count < 40; ++count) {
    Pieces pieces(count);
    std::vector<std::array<double, 3>> all;
    for (Piece& piece : pieces)
      for (Vec3d& c : piece.corners) all.push_back({(c = corner()).x, c.y, c.z});
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const std::vector<Vec3d> corners = cornersOf(pieces);
    ASSERT_EQ(corners.size(), all.size()) << "seed " << kSeed;
    for (std::size_t i = 0; i < all.size(); ++i)
      ASSERT_EQ(corners[i], Vec3d(all[i][0], all[i][1], all[i][2])) << "seed " << kSeed << ", corner " << i;
  }
}

std::vector<Vec3d> pointsOf(const TriangleMesh& mesh) {
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, 2000);
  return cornersOf(pieces);
}

/// The stand-off of the ball around a center, by a search of all the points and of the whole field.
StandOff::Value wholeStandOff(const PointSet& points, const DepthField& field, const Vec3d& center) {
  const PointSet::Farthest farthest = points.farthest(center);
  const DepthField::Sample sample = field.at(center);
  const Vec3d away = center - points[farthest.index];
  return {{center, farthest.distance, sample.depth}, away / length(away) - sample.rise};
}

/// Walks about as a descent does: some steps from one centre, then on to the last.
void expectSameNear(const PointSet& points, const DepthField& field, double size) {
  std::mt19937_64 engine(kSeed);
  for (int walk = 0; walk < 40; ++walk) {
    StandOff standOff(points, field);
    const Vec3d start = randomPoint(engine) * (0.5 * size);
    StandOff::Value around = standOff.at(start, field.depth(start));
    ASSERT_EQ(around.ball.depth, field.depth(start)) << "seed " << kSeed << ", walk " << walk;
    double reach = size * std::pow(10.0, uniform(engine, -4, -0.5));
    for (int step = 0; step < 60; ++step) {
      if (step % 13 == 0) reach *= uniform(engine, 0.3, 1.6);
      const Vec3d direction = normalized(randomPoint(engine));
      const Vec3d center = around.ball.center + direction * (step % 3 == 0 ? reach : reach * uniform(engine));
      const StandOff::Value near = standOff.near(around, reach, center), whole = wholeStandOff(points, field, center);
      ASSERT_EQ(near.ball.radius, whole.ball.radius) << "seed " << kSeed << ", walk " << walk << ", step " << step;
      ASSERT_EQ(near.ball.depth, whole.ball.depth) << "seed " << kSeed << ", walk " << walk << ", step " << step;
      ASSERT_EQ(near.gradient, whole.gradient) << "seed " << kSeed << ", walk " << walk << ", step " << step;
      if (step % 7 == 6) around = near;
    }
  }
}

TEST(StandOff, NearACentre_IsWhatLookingAtEverythingGives) {
  for (const TriangleMesh& mesh : {test::lumpyBall(3, 4), test::torus(1, 0.3, 30, 16)}) {
    const SignedDistance solid(mesh);
    const PointSet points(pointsOf(mesh));
    expectSameNear(points, SolidDepth(solid), boundsOf(mesh).diagonal());
    expectSameNear(points, ClosedDepth(solid, 0.1, 0.05, boundsOf(mesh).center(), boundsOf(mesh).diagonal()),
                   boundsOf(mesh).diagonal());
  }
}

TEST(SignedDistance, DeepInARoundBody_NoTriangleIsNearerThanTheAnswer) {
  for (const double far : {0.0, 1e6}) {
    // Slabs leave out most of a body whose triangles are all nearly as near.
    TriangleMesh mesh = test::meshOf(test::ball(1, 3));
    for (Vec3d& v : mesh.vertices) v = Vec3d(v.x, 0.9 * v.y, 0.8 * v.z) + Vec3d(far, -far, far);
    const SignedDistance solid(mesh);
    std::mt19937_64 engine(kSeed);
    for (int i = 0; i < 1000; ++i) {
      const Vec3d q = boundsOf(mesh).center() + randomPoint(engine) * std::pow(10.0, uniform(engine, -8, 1));
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) least = std::min(least, solid.distanceToTriangle(t, q));
      // Boxes may be passed over when they are as far but for rounding.
      ASSERT_LE(solid.closest(q).distance, least + 2 * solid.roundingBound(q)) << "seed " << kSeed << ", case " << i;
    }
  }
}

TEST(SignedDistance, QueryWithAKnownDistance_GivesTheSameBits) {
  for (const double far : {0.0, 1e6}) {
    TriangleMesh mesh = test::lumpyBall(3, 6);
    for (Vec3d& v : mesh.vertices) v += Vec3d(far, -far, far);
    const SignedDistance solid(mesh);
    std::mt19937_64 engine(kSeed);
    for (int i = 0; i < 20000; ++i) {
      // Every fourth on a vertex, where many triangles tie.
      const Vec3d q = i % 4 == 0 ? mesh.vertices[engine() % mesh.vertices.size()]
                                 : boundsOf(mesh).center() + randomPoint(engine) * 2;
      const SignedDistance::Answer plain = solid.query(q), known = solid.query(q, plain.nearest.distance);
      ASSERT_EQ(plain.nearest.triangle, known.nearest.triangle) << "seed " << kSeed << ", case " << i;
      ASSERT_EQ(plain.depth, known.depth) << "seed " << kSeed << ", case " << i;
    }
  }
}

std::vector<Vec3d> exhaustiveSample(const std::vector<Vec3d>& points, std::size_t count, std::size_t first) {
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3d> sample;
  for (std::size_t next = first; sample.size() < count;) {
    sample.push_back(points[next]);
    for (std::size_t i = 0; i < points.size(); ++i)
      nearest[i] = std::min(nearest[i], distance(points[i], points[next]));
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    if (nearest[next] == 0) break;
  }
  return sample;
}

TEST(FarthestSample, TakesThePointsOfAnExhaustiveSearch) {
  std::mt19937_64 engine(kSeed);
  std::vector<Vec3d> scattered, grid;
  for (int i = 0; i < 3000; ++i) scattered.push_back(randomPoint(engine));
  // Points of a grid tie in every step; each is there twice.
  for (int i = 0; i < 2000; ++i) grid.emplace_back(0.1 * (i % 10), 0.1 * (i / 10 % 10), 0.1 * (i / 100 % 10));
  EXPECT_EQ(farthestPointSample(scattered, 300, 17), exhaustiveSample(scattered, 300, 17)) << "seed " << kSeed;
  EXPECT_EQ(farthestPointSample(grid, 1500, 5), exhaustiveSample(grid, 1500, 5));
  EXPECT_EQ(farthestPointSample(grid, 1500, 5).size(), 1000U);
}

TEST(NearestBall, IsThatOfAnExhaustiveSearch) {
  std::mt19937_64 engine(kSeed);
  std::vector<EnclosingBall> balls;
  for (int i = 0; i < 500; ++i) balls.push_back({randomPoint(engine), 0.2 * uniform(engine)});
  for (int i = 0; i < 100; ++i) balls.push_back(balls[engine() % 500]);  // ties
  const NearestBall nearest(balls);
  for (int i = 0; i < 5000; ++i) {
    const Vec3d q = randomPoint(engine) * 1.5;
    std::size_t expected = 0;
    for (std::size_t k = 1; k < balls.size(); ++k)
      if (distance(q, balls[k].center) - balls[k].radius < distance(q, balls[expected].center) - balls[expected].radius)
        expected = k;
    ASSERT_EQ(nearest.to(q), expected) << "seed " << kSeed << ", case " << i;
  }
}

TEST(HubbardError, OfMergedSets_IsTheLargestOfAllNormalsAndItsBoundIsNoLarger) {
  const TriangleMesh mesh = test::lumpyBall(2, 9);
  const SignedDistance solid(mesh);
  const HubbardMedial medial = hubbardMedialOf(solid, 150, 2);
  const HubbardError error(medial);
  std::mt19937_64 engine(kSeed);
  const auto randomSet = [&] {
    std::vector<std::uint32_t> samples(1 + engine() % 150);
    for (std::uint32_t& s : samples) s = static_cast<std::uint32_t>(engine() % medial.samples.size());
    std::sort(samples.begin(), samples.end());
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    return SampleSet(samples, medial);
  };
  for (int i = 0; i < 300; ++i) {
    const SampleSet a = randomSet(), b = randomSet(), both(a, b);
    const EnclosingBall ball = both.ritterBall(), grown = ritterBallOfBoth(a, b);
    ASSERT_EQ(grown.center, ball.center) << "seed " << kSeed << ", case " << i;
    ASSERT_LE(grown.radius, ball.radius);
    double worst = 0;
    for (std::size_t k = 0; k < both.size(); ++k)
      for (const std::uint32_t cluster : medial.samples[both.sample(k)].clusters)
        worst =
            std::max(worst, normalStandOff(ball.center, ball.radius, both.point(k), medial.clusterNormals[cluster]));
    ASSERT_EQ(error.of(ball, both), worst) << "seed " << kSeed << ", case " << i;
    ASSERT_LE(error.atLeast(a, b), worst) << "seed " << kSeed << ", case " << i;
  }
}

TEST(Build, HubbardIsCancelledWhileItMerges) {
  const TriangleMesh mesh = test::lumpyBall(3, 9);
  BuildOptions options;
  options.method = Method::hubbard;
  int calls = 0;
  EXPECT_TRUE(buildTree(mesh, options, [&](std::string_view, double) { return ++calls > 0; }));
  const int all = calls;
  ASSERT_GT(all, 10);
  // Wherever it is told to stop, it does so at once: it asks no more than once for each thread.
  options.threads = 1;
  for (const int last : {2, 4, all / 2}) {
    calls = 0;
    const auto tree = buildTree(mesh, options, [&](std::string_view, double) { return ++calls < last; });
    ASSERT_FALSE(tree) << "stopped at call " << last;
    EXPECT_EQ(tree.error().message, kCancelled);
    EXPECT_EQ(calls, last);
  }
}

}  // namespace
}  // namespace cairn::builder
