// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <utility>
#include <vector>

#include "brute_force_pairs.h"
#include "scenes/bodies/rock.h"
#include "scenes/figures/random.h"
#include "scenes/truth/exact_check.h"
#include "test_solids.h"

namespace cairn::scenes::exact_check_pairs_test {
namespace {

constexpr std::uint64_t kSeed = 20021;
constexpr int kPairs = 1000;
/// Rounding of double precision over a few dozen operations on lengths of about 1.
constexpr double kRounding = 1e-12;
constexpr double kDepthTolerance = 1e-3;

/// A solid of some tens to hundreds of faces, a quarter to 1 across, stretched along its axes.
builder::TriangleMesh randomSolid(Random& random) {
  builder::TriangleMesh mesh;
  const auto take = [&](test::Solid solid) {
    mesh.vertices = std::move(solid.vertices);
    mesh.triangles = std::move(solid.triangles);
  };
  const auto pick = [&](int from, int to) { return from + static_cast<int>(random.uniform(0, to - from + 1)); };
  switch (pick(0, 15)) {
    case 0:
      take(test::torus(random.uniform(0.3, 0.45), random.uniform(0.08, 0.2), 2 * pick(3, 6)));
      break;
    case 1:
      take(test::bowl(random.uniform(0.45, 0.6), random.uniform(0.25, 0.4), 4 * pick(2, 3)));
      break;
    case 2:
      take(test::cuboid({0.7, 0.7, 0.7}, pick(1, 3)));
      break;
    case 3:
      take(test::ball(0.5, pick(1, 3)));
      break;
    case 4:  // hundreds of faces: no more of them than a test has time for
      mesh = generateRock({random.bits(), 2});
      break;
    default:
      mesh = generateRock({random.bits(), 1});
  }
  const double scale = random.uniform(0.2, 1.2);
  const Vec3d stretch{scale * random.uniform(0.6, 1.4), scale * random.uniform(0.6, 1.4),
                      scale * random.uniform(0.6, 1.4)};
  for (Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] *= stretch[axis];
  return mesh;
}

/// How often each case occurred: a test that never saw one shows nothing of it.
struct Seen {
  int crossing = 0, apart = 0, nested = 0, inside = 0, outside = 0;
};

void checkPoints(const ExactSurface& surface, const builder::TriangleMesh& mesh, Random& random, Seen& seen) {
  const test::DistanceOracle oracle{mesh};
  for (int i = 0; i < 4; ++i) {
    const Vec3d point = random.direction() * random.uniform(0, 0.5);
    const double depth = oracle.depth(point);
    EXPECT_NEAR(surface.depth(point), depth, kRounding);
    ++(depth > 0 ? seen.inside : seen.outside);
  }
}

void checkPair(Random& random, Seen& seen) {
  const builder::TriangleMesh meshA = randomSolid(random), meshB = randomSolid(random);
  const auto a = ExactSurface::create(meshA.vertices, meshA.triangles),
             b = ExactSurface::create(meshB.vertices, meshB.triangles);
  ASSERT_TRUE(a && b);
  const Placement bFromA =
      test::turned(random.direction(), random.uniform(0, 3), random.direction() * random.uniform(0, 1.3));
  const test::BruteForcePair brute(meshA, meshB, bFromA);

  const double gap = brute.separation();
  EXPECT_EQ(surfacesMeet(a.value(), b.value(), bFromA), gap == 0);
  EXPECT_NEAR(surfaceDistance(a.value(), b.value(), bFromA), gap, kRounding);
  const double vertexDepth = brute.deepestVertex();
  const double depth = mutualPenetration(a.value(), b.value(), bFromA, kDepthTolerance);
  EXPECT_GE(depth, vertexDepth - kRounding);
  if (gap > 0 && vertexDepth == 0) EXPECT_EQ(depth, 0) << "solids that are apart";
  checkPoints(a.value(), meshA, random, seen);
  checkPoints(b.value(), meshB, random, seen);
  ++(gap == 0 ? seen.crossing : vertexDepth > 0 ? seen.nested : seen.apart);
}

/// Whether surfaces meet, how far apart they are, that nothing is deeper than it can be and where points lie, against
/// all pairs of triangles and winding numbers.
TEST(ExactCheck_AThousandPairs, AgreesWithBruteForceOnAll) {
  Random random(kSeed);
  Seen seen;
  for (int pair = 0; pair < kPairs; ++pair) {
    SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", pair " << pair);
    checkPair(random, seen);
    if (HasFatalFailure()) return;
  }
  std::cout << "seed " << kSeed << ": " << seen.crossing << " pairs cross, " << seen.apart << " are apart, "
            << seen.nested << " nested; " << seen.inside << " points inside, " << seen.outside << " outside\n";
  EXPECT_GT(seen.crossing, kPairs / 4);
  EXPECT_GT(seen.apart, kPairs / 4);
  EXPECT_GT(seen.nested, kPairs / 100);
  EXPECT_GT(seen.inside, kPairs);
  EXPECT_GT(seen.outside, kPairs);
}

}  // namespace
}  // namespace cairn::scenes::exact_check_pairs_test
