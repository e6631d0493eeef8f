// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/interpenetration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_trees.h"
#include "scenes/heap/heap.h"

namespace cairn::scenes::interpenetration_test {
namespace {

TEST(Interpenetration_OfAFreshHeap, IsNone) {
  HeapOptions options;
  options.bodies = 27;
  options.world.shape = ShapeKind::hull;
  const auto heap = Heap::create(makeModel(test::smallRockTree(), 1.0), options);
  ASSERT_TRUE(heap);
  const auto found = measureInterpenetration(*heap.value());
  ASSERT_TRUE(found);
  EXPECT_EQ(found.value().depth.pairs, 0U);
  EXPECT_EQ(found.value().gap.pairs, 0U);
  EXPECT_EQ(found.value().pitDepth.pairs, 0U);
  EXPECT_EQ(found.value().pitGap.pairs, 0U);
}

/// Bodies put where their overlap is known: the same body twice, and one sunk into the ground.
TEST(Interpenetration_OfMovedBodies, IsWhatTheMoveMade) {
  HeapOptions options;
  options.bodies = 2;
  options.world.shape = ShapeKind::hull;
  const Model model = makeModel(test::smallRockTree(), 1.0);
  const auto heap = Heap::create(model, options);
  ASSERT_TRUE(heap);
  const auto bodies = heap.value()->world().bodies();
  btTransform pose = btTransform::getIdentity();
  double lowest = 0;
  for (const Vec3d& v : model.vertices) lowest = std::min(lowest, v.z);
  constexpr double kSunk = 0.1;
  pose.setOrigin(toBullet({0, 0, -lowest - kSunk}));
  bodies[0]->setWorldTransform(pose);
  pose.getOrigin() += btVector3(0, 0, btScalar(0.01));
  bodies[1]->setWorldTransform(pose);
  const auto found = measureInterpenetration(*heap.value());
  ASSERT_TRUE(found);
  const double rounding = 1e-5;  // single-precision poses about a metre from the origin
  EXPECT_EQ(found.value().pitDepth.pairs, 2U);
  EXPECT_NEAR(found.value().pitDepth.max, kSunk, rounding);
  EXPECT_NEAR(found.value().pitDepth.mean, kSunk - 0.005, rounding);
  ASSERT_EQ(found.value().depth.pairs, 1U);
  // A surface moved by 1 cm is nowhere deeper than that in its own copy, and somewhere nearly so (its top and bottom).
  EXPECT_LE(found.value().depth.max, 0.01 + rounding);
  EXPECT_GE(found.value().depth.max, 0.009 - kDepthToleranceFraction);
}

}  // namespace
}  // namespace cairn::scenes::interpenetration_test
