// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces that cross themselves wind backwards around parts of space. Repair makes these parts solid, so that
// no triangle of the source is left outside. Judged by winding numbers of the source.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "distance_oracle.h"
#include "surface/mass_properties.h"

namespace cairn::builder::folds_test {
namespace {

/// Corners are rounded to float, then the cuts between triangles: a few units of 2^-24, as a fraction of the size.
constexpr double kRounding = 1e-6;
/// Folds are made larger, by one and a half times the weld, and by at most eight times as much at needles.
constexpr double kGrown = 8 * 1.5 * RepairOptions().weld;

/// A ball some of whose vertices are pushed through the other side.
TriangleMesh foldedBall(std::uint64_t seed) {
  TriangleMesh mesh = test::lumpyBall(6, seed);
  std::mt19937_64 engine(seed);
  for (int i = 0; i < 4; ++i) {
    Vec3d& v = mesh.vertices[engine() % mesh.vertices.size()];
    v = v * test::uniform(engine, -1.6, -0.2);
  }
  return mesh;
}

/// Two boxes of one surface, of which the part at small x winds backwards.
TriangleMesh crossedBox() {
  TriangleMesh bow = test::meshOf(test::cuboid({1, 1, 1}, 2));
  for (Vec3d& v : bow.vertices)
    if (v.x < -0.25) v = {v.x, v.y, -v.z};
  return bow;
}

TriangleMesh boxAt(const Vec3d& center, const Vec3d& size) {
  return test::moved(test::meshOf(test::cuboid(size, 1)), [&](const Vec3d& v) { return v + center; });
}

/// How many of the points have another side in the repaired mesh than by winding numbers, though they are not on the
/// surface. `backward`: counts points around which the source winds backwards.
/// Of several bodies each has its own winding numbers.
int wrongPoints(const std::vector<TriangleMesh>& bodies, const TriangleMesh& solid, std::uint64_t seed, int& backward) {
  const test::DistanceOracle after{solid};
  std::vector<test::DistanceOracle> before;
  TriangleMesh whole;
  for (const TriangleMesh& body : bodies) {
    before.emplace_back(body);
    whole = test::joined(whole, body);
  }
  const Bounds bounds = boundsOf(whole);
  std::mt19937_64 engine(seed);
  int wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec3d p = bounds.center();
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += test::uniform(engine, -0.55, 0.55) * (bounds.upper[axis] - bounds.lower[axis]);
    double least = 0, greatest = 0, distance = bounds.diagonal();
    for (const test::DistanceOracle& body : before) {
      const double winding = body.windingNumber(p);
      least = std::min(least, winding);
      greatest = std::max(greatest, winding);
      distance = std::min(distance, body.distance(p));
    }
    const bool wasSolid = greatest > 0.5 || least < -0.5;
    if (distance < (wasSolid ? kRounding : kGrown) * bounds.diagonal()) continue;
    backward += least < -0.5;
    wrong += wasSolid != (after.windingNumber(p) > 0.5);
  }
  return wrong;
}

TEST(Folds, BothLobesOfACrossedBoxAreSolid) {
  const TriangleMesh bow = crossedBox();
  RepairCounts counts;
  const Result<TriangleMesh> solid = repair(bow, &counts);
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_TRUE(checkMesh(solid.value()).ok());
  int backward = 0;
  EXPECT_EQ(wrongPoints({bow}, solid.value(), 1, backward), 0);
  EXPECT_GT(backward, 100);
  EXPECT_GT(counts.foldedTriangles, 0U);
  EXPECT_NE(counts.text().find("folds that wound backwards"), std::string::npos) << counts.text();
}

// Without a weld folds still grow by some units of floats.
TEST(Folds, NeedNoWeld) {
  const TriangleMesh bow = crossedBox();
  const Result<TriangleMesh> solid = repair(bow, nullptr, {.weld = 0});
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  int backward = 0;
  EXPECT_EQ(wrongPoints({bow}, solid.value(), 2, backward), 0);
}

TEST(Folds, AreSolidWhereTheSurfaceWindsAtAll) {
  int backward = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TriangleMesh source = foldedBall(seed);
    const Result<TriangleMesh> solid = repair(source);
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_TRUE(checkMesh(solid.value()).ok());
    EXPECT_EQ(wrongPoints({source}, solid.value(), seed, backward), 0);
  }
  EXPECT_GT(backward, 100);
}

// Sums of winding numbers would cancel where a body lies in another one's fold.
TEST(Folds, HoldOtherBodies) {
  const TriangleMesh bow = crossedBox();
  const std::vector<TriangleMesh> others{
      boxAt({-0.4, 0, 0}, {0.1, 0.1, 0.1}), boxAt({-0.45, 0.1, 0.05}, {0.4, 0.3, 0.2}),
      boxAt({0, 0.13, 0.02}, {2, 0.3, 0.3}), test::moved(test::flipped(bow), [](const Vec3d& v) {
        return v + Vec3d{0.05, 0.03, 0.02};
      })};
  int backward = 0;
  for (const TriangleMesh& other : others) {
    const TriangleMesh both = test::joined(bow, other);
    const Result<TriangleMesh> solid = repair(both);
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_TRUE(checkMesh(solid.value()).ok());
    EXPECT_EQ(wrongPoints({bow, other}, solid.value(), 3, backward), 0) << &other - others.data();
  }
  EXPECT_GT(backward, 100);
}

TEST(Folds, OfSeveralBodiesAreSolidWhereAnyWinds) {
  int backward = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TriangleMesh first = foldedBall(seed);
    const TriangleMesh second = test::moved(foldedBall(seed + 100), [](const Vec3d& v) {
      return v + Vec3d{0.31, 0.17, 0.11};
    });
    const Result<TriangleMesh> solid = repair(test::joined(first, second));
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_EQ(wrongPoints({first, second}, solid.value(), seed, backward), 0);
  }
  EXPECT_GT(backward, 50);
}

TEST(Hollows, ThatOverlapOrLieInEachOtherAreOneHollow) {
  const TriangleMesh box = boxAt({}, {1, 1, 1});
  const auto hollow = [](const Vec3d& center, double size) { return test::flipped(boxAt(center, {size, size, size})); };
  struct Trial {
    TriangleMesh mesh;
    double volume;
  };
  const Trial trials[] = {
      {test::joined(test::joined(box, hollow({}, 0.6)), hollow({}, 0.2)), 1 - 0.216},
      {test::joined(test::joined(box, hollow({-0.1, -0.1, -0.1}, 0.4)), hollow({0.1, 0.1, 0.1}, 0.4)), 1 - 0.12},
      {test::joined(test::joined(box, hollow({}, 0.6)), boxAt({}, {0.2, 0.2, 0.2})), 1 - 0.216 + 0.008}};
  for (const auto& [mesh, volume] : trials) {
    RepairCounts counts;
    const Result<TriangleMesh> solid = repair(mesh, &counts);
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_EQ(counts.foldedTriangles, 0U);
    EXPECT_TRUE(&mesh == &trials[2].mesh || counts.any()) << counts.text();
    EXPECT_NEAR(signedVolume(solid.value()), volume, 6 * kRounding) << counts.text();
  }
}

// A bar through the walls of a hollow is larger than the hollow, and has a hollow of its own in there.
TEST(Hollows, BelongToTheBodyTheyAreIn) {
  const TriangleMesh box = test::joined(boxAt({}, {10, 10, 10}), test::flipped(boxAt({}, {3, 3, 3})));
  const TriangleMesh bar = test::joined(boxAt({}, {1, 1, 6}), test::flipped(boxAt({}, {0.5, 0.5, 0.5})));
  const Result<TriangleMesh> solid = repair(test::joined(box, bar));
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_NEAR(signedVolume(solid.value()), 1000 - 27 + 3 - 0.125, 1000 * kRounding);
}

TEST(Folds, AreNotCountedWhereNoneIs) {
  RepairCounts counts;
  TriangleMesh second = test::moved(test::lumpyBall(4, 2), [](const Vec3d& v) { return v + Vec3d{0.7, 0.1, 0}; });
  ASSERT_TRUE(repair(test::joined(test::lumpyBall(4, 1), second), &counts).ok());
  EXPECT_GT(counts.cutTriangles, 0U);
  EXPECT_EQ(counts.foldedTriangles, 0U);
}

}  // namespace
}  // namespace cairn::builder::folds_test
