// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/crush_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "distance_oracle.h"
#include "scene_trees.h"
#include "scenes/truth/placed_body.h"
#include "shape_names.h"

namespace cairn::scenes::crush_test {
namespace {

constexpr ShapeKind kSimulatedShapes[] = {ShapeKind::tree, ShapeKind::treeLeaves, ShapeKind::gimpact, ShapeKind::hull,
                                          ShapeKind::spheres};

const Model& rock() {
  static const Model model = makeModel(test::smallRockTree(), 1.0);
  return model;
}

CrushStart startOf(std::uint32_t bodies, std::uint64_t seed = 1) {
  auto start = crushStart(rock(), bodies, seed);
  EXPECT_TRUE(start) << start.error().message;
  return std::move(start).value();
}

HeapOptions crushed(const CrushStart& start, ShapeKind shape) {
  HeapOptions options;
  options.bodies = static_cast<std::uint32_t>(start.poses.size());
  options.start = start.poses;
  options.world.shape = shape;
  return options;
}

/// Deepest corner of any body in any other by brute force: the answer for whole surfaces is at least that.
double deepestCorner(const CrushStart& start) {
  builder::TriangleMesh mesh;
  mesh.vertices = rock().vertices;
  mesh.triangles.assign(rock().triangles.begin(), rock().triangles.end());
  const test::DistanceOracle oracle{mesh};
  double deepest = 0;
  for (std::size_t i = 0; i < start.poses.size(); ++i)
    for (std::size_t j = 0; j < start.poses.size(); ++j) {
      const Placement jFromI = relativePlacement(placementOf(start.poses[i]), placementOf(start.poses[j]));
      for (const Vec3d& v : rock().vertices)
        if (i != j && length(jFromI * v) < rock().reach) deepest = std::max(deepest, oracle.depth(jFromI * v));
    }
  return deepest;
}

TEST(Crush_Start, IsAsDeepAsSaidAndNoDeeperThanAllowed) {
  const CrushStart start = startOf(6);
  EXPECT_GE(start.depth.pairs, 5U);
  EXPECT_LE(start.depth.max, kDeepestStartFraction);
  EXPECT_GT(start.depth.max, 0.5 * kDeepestStartFraction) << "this rock is thick enough";
  const double corner = deepestCorner(start);
  EXPECT_GE(start.depth.max, corner - kDepthToleranceFraction);
  // Between its corners a rock of 320 triangles can reach deeper, but hardly by a twentieth of its size.
  EXPECT_LE(start.depth.max, corner + 0.05);
}

TEST(Crush_Start, IsTheSameForTheSameSeedAndAboveTheGround) {
  const CrushStart start = startOf(20), again = startOf(20), other = startOf(20, 2);
  for (std::size_t i = 0; i < start.poses.size(); ++i) {
    EXPECT_TRUE(start.poses[i] == again.poses[i]);
    EXPECT_FALSE(start.poses[i] == other.poses[i]);
    EXPECT_GT(placeBody(start.poses[i], rock()).box.lower.z, 0);
  }
}

TEST(Crush_EveryShape, HasTheSameStartInsideThePit) {
  const CrushStart start = startOf(20);
  for (const ShapeKind shape : kSimulatedShapes) {
    const auto heap = Heap::create(rock(), crushed(start, shape));
    ASSERT_TRUE(heap);
    const auto poses = heap.value()->world().poses();
    ASSERT_EQ(poses.size(), start.poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_TRUE(poses[i] == start.poses[i]) << shapeName(shape);
      for (const HalfSpace& face : heap.value()->pit().faces())
        for (const Vec3d& v : placeBody(poses[i], rock()).vertices) EXPECT_GE(dot(face.normal, v), face.offset);
    }
  }
}

class CrushOfShape : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(CrushOfShape, ComesApartAndSaysWhen) {
  const CrushStart start = startOf(8);
  const auto heap = Heap::create(rock(), crushed(start, GetParam()));
  ASSERT_TRUE(heap);
  CrushCourse course;
  const auto report = runCrush(*heap.value(), 240, course);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(course.worstPenetration.size(), 1 + 240 / kCourseInterval);
  EXPECT_EQ(course.worstPenetration.front(), start.depth.max);
  EXPECT_NEAR(course.worstPenetration.back(), report.value().end.depth.max, kDepthToleranceFraction);
  EXPECT_EQ(report.value().lost, 0U);
  if (!course.resolvedAfter) {
    EXPECT_GE(course.worstPenetration.back(), kResolvedFraction);
    return;
  }
  const auto first = static_cast<std::size_t>(std::lround(*course.resolvedAfter * 60 / kCourseInterval));
  ASSERT_GT(first, 0U) << "they start deep";
  EXPECT_GE(course.worstPenetration[first - 1], kResolvedFraction);
  for (std::size_t i = first; i < course.worstPenetration.size(); ++i)
    EXPECT_LT(course.worstPenetration[i], kResolvedFraction);
}
INSTANTIATE_TEST_SUITE_P(Crush, CrushOfShape, ::testing::ValuesIn(kSimulatedShapes), test::shapeTestName);

TEST(Crush_EmptyStep, CostsLessThanTheCrush) {
  const CrushStart start = startOf(8);
  const HeapOptions options = crushed(start, ShapeKind::tree);
  const auto empty = measureEmptyStep(rock(), options);
  ASSERT_TRUE(empty);
  EXPECT_GT(empty.value(), 0);
  const auto heap = Heap::create(rock(), options);
  ASSERT_TRUE(heap);
  EXPECT_LT(empty.value(), heap.value()->step().narrowPhaseCpuUs);
}

TEST(Crush_SameSeed, GivesTheSameBitsTwice) {
  const CrushStart start = startOf(8);
  HeapOptions options = crushed(start, ShapeKind::tree);
  options.world.budget.operations = 3000;
  std::string hashes[2];
  for (std::string& hash : hashes) {
    const auto heap = Heap::create(rock(), options);
    CrushCourse course;
    hash = runCrush(*heap.value(), 30, course).value().stateHash;
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace cairn::scenes::crush_test
