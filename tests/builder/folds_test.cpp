// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces that cross themselves wind backwards around parts of space. Repair makes these parts solid, so that
// no triangle of the source is left outside. Judged by winding numbers of the source.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

/// How many of the points have another side in the repaired mesh than by winding numbers, though they are not on the
/// surface. `backward`: counts points around which the source winds backwards.
int wrongPoints(const TriangleMesh& source, const TriangleMesh& solid, std::uint64_t seed, int& backward) {
  const test::DistanceOracle before{source}, after{solid};
  const Bounds bounds = boundsOf(source);
  std::mt19937_64 engine(seed);
  int wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec3d p = bounds.center();
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += test::uniform(engine, -0.55, 0.55) * (bounds.upper[axis] - bounds.lower[axis]);
    const double winding = before.windingNumber(p);
    const bool wasSolid = std::abs(winding) > 0.5;
    if (before.distance(p) < (wasSolid ? kRounding : kGrown) * bounds.diagonal()) continue;
    backward += winding < -0.5;
    wrong += wasSolid != (after.windingNumber(p) > 0.5);
  }
  return wrong;
}

TEST(Folds, BothLobesOfACrossedBoxAreSolid) {
  TriangleMesh bow = test::meshOf(test::cuboid({1, 1, 1}, 2));
  for (Vec3d& v : bow.vertices)
    if (v.x < -0.25) v = {v.x, v.y, -v.z};
  RepairCounts counts;
  const Result<TriangleMesh> solid = repair(bow, &counts);
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_TRUE(checkMesh(solid.value()).ok());
  int backward = 0;
  EXPECT_EQ(wrongPoints(bow, solid.value(), 1, backward), 0);
  EXPECT_GT(backward, 100);
  EXPECT_GT(counts.foldedTriangles, 0U);
  EXPECT_NE(counts.text().find("folds that wound backwards"), std::string::npos) << counts.text();
}

// Without a weld folds still grow by some units of floats.
TEST(Folds, NeedNoWeld) {
  TriangleMesh bow = test::meshOf(test::cuboid({1, 1, 1}, 2));
  for (Vec3d& v : bow.vertices)
    if (v.x < -0.25) v = {v.x, v.y, -v.z};
  const Result<TriangleMesh> solid = repair(bow, nullptr, {.weld = 0});
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  int backward = 0;
  EXPECT_EQ(wrongPoints(bow, solid.value(), 2, backward), 0);
}

TEST(Folds, AreSolidWhereTheSurfaceWindsAtAll) {
  int backward = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TriangleMesh source = foldedBall(seed);
    const Result<TriangleMesh> solid = repair(source);
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_TRUE(checkMesh(solid.value()).ok());
    EXPECT_EQ(wrongPoints(source, solid.value(), seed, backward), 0);
  }
  EXPECT_GT(backward, 100);
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
