// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that leave out what cannot matter, each against looking at everything: the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "balls/farthest_sample.h"
#include "balls/nearest_ball.h"
#include "balls/stand_off.h"
#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "medial/hubbard_medial.h"
#include "spheres/hubbard.h"
#include "spheres/hubbard_error.h"

namespace cairn::builder::fast_paths_test {
namespace {

using test::randomPoint;
using test::uniform;

constexpr std::uint64_t kSeed = 20261121;

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
  StandOffMemory memory;  // one for all, as what an earlier walk left must not matter
  for (int walk = 0; walk < 40; ++walk) {
    StandOff standOff(points, field, memory);
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

/// Straight out from, and straight in of, the corners and the middles of edges and faces: many triangles tie there.
TEST(QueryAmong, WhereTrianglesTie_NamesTheOneOfTheFullSearch) {
  std::mt19937_64 engine(kSeed);
  std::size_t compared = 0;
  for (const TriangleMesh& mesh :
       {test::meshOf(test::cuboid({2, 2, 2}, 6)), test::torus(1, 0.3, 30, 16), test::lumpyBall(3, 4)}) {
    const SignedDistance solid(mesh);
    std::vector<NearPacket> parts;
    for (int round = 0; round < 3000; ++round) {
      const auto corners = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
      const double weights[3][3] = {{1, 0, 0}, {0.5, 0.5, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
      const double* w = weights[round % 3];
      const Vec3d on = corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
      const Vec3d normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
      // Powers of two, so that a point is often at one distance to the bit from what ties.
      const Vec3d point = on + normal * (std::ldexp(engine() % 2 == 0 ? 1.0 : -1.0, -static_cast<int>(engine() % 8)));
      const double reach = 0.1 * uniform(engine);
      const Vec3d center = point + normalized(randomPoint(engine)) * (0.99 * reach);
      if (!solid.gather(center, solid.closest(center).distance, reach, 256, parts)) continue;
      ++compared;
      const SignedDistance::Answer among = solid.queryAmong(parts, point, reach), whole = solid.query(point);
      ASSERT_EQ(among.nearest.triangle, whole.nearest.triangle) << "seed " << kSeed << ", round " << round;
      ASSERT_EQ(among.depth, whole.depth) << "seed " << kSeed << ", round " << round;
      ASSERT_EQ(among.nearest.point, whole.nearest.point) << "seed " << kSeed << ", round " << round;
    }
  }
  EXPECT_GT(compared, 6000U);
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
}  // namespace cairn::builder::fast_paths_test
