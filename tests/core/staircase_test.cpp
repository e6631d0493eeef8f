// SPDX-License-Identifier: Zlib
#include <gtest/gtest.h>

#include "cairn/core/tree_pair_traversal.h"
#include "every_target.h"
#include "random_tree.h"
#include "reference_traversal.h"

namespace cairn::staircase_test {
namespace {

SphereTree randomTree(std::uint64_t seed, std::uint32_t points, std::uint32_t depth, bool twoSpheres) {
  test::RandomTree random = test::randomTree(seed, points, depth);
  if (twoSpheres) test::addBounds(random, seed);
  return std::move(SphereTree::create(std::move(random.data))).value();
}

/// Pairs of unlike trees, so that leaves of one meet inner nodes of the other, in unlike scales. Every third tree has
/// two spheres a node.
struct StaircaseCase {
  explicit StaircaseCase(std::uint64_t seed) : engine(seed), twoSpheres(seed % 3) {
    poseA = test::randomPose(engine, 0.6);
    poseB = test::randomPose(engine, 0.6);
  }

  std::mt19937_64 engine;
  std::uint64_t twoSpheres;
  SphereTree treeA = randomTree(engine(), 400, static_cast<std::uint32_t>(engine() % 4), twoSpheres == 1);
  SphereTree treeB = randomTree(engine(), 150, static_cast<std::uint32_t>(1 + engine() % 3), twoSpheres == 2);
  Pose poseA, poseB;
  static constexpr float kMargin = 0.02F;
};

using StaircaseOnEveryTarget = test::EveryTarget;

// Cut at random operations: front and leaf pairs are the reference's, pair by pair and in its order, and so is the
// cost.
TEST_F(StaircaseOnEveryTarget, AtEveryCut_SamePairsInTheSameOrderAsTheReference) {
  onEveryTarget([] {
    std::size_t steps = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      StaircaseCase c(seed);
      test::ReferenceTraversal reference(c.treeA, c.treeB, c.poseA, c.poseB, c.kMargin);
      TreePairTraversal traversal;
      traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.kMargin);
      std::uint64_t paid = 0, spent = 0;
      while (!traversal.done()) {
        Budget budget = Budget::operations(c.engine() % 300);
        (void)traversal.refine(budget);
        spent += budget.used();
        while (paid < spent) paid += reference.refineOne();
        ASSERT_EQ(paid, spent) << "seed " << seed;
        ASSERT_TRUE(std::ranges::equal(traversal.front(), reference.front)) << "seed " << seed;
        ASSERT_TRUE(std::ranges::equal(traversal.leafPairs(), reference.leafPairs)) << "seed " << seed;
      }
      EXPECT_EQ(reference.refineOne(), 0U);
      steps += reference.steps.size();
    }
    EXPECT_GT(steps, 5000U) << "the cases must mostly touch to mean anything";
  });
}

// A budget that refuses a step refuses it for want of operations, not because eight were prepared together.
TEST_F(StaircaseOnEveryTarget, ARefusedStep_WouldNotHaveFitted) {
  onEveryTarget([] {
    StaircaseCase c(3);
    TreePairTraversal traversal;
    traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.kMargin);
    ASSERT_FALSE(traversal.done());
    while (!traversal.done()) {
      Budget budget = Budget::operations(10 + c.engine() % 90);
      if (traversal.refine(budget) == Progress::done) break;
      const NodePair next = traversal.front()[0];
      const bool intoA = c.treeB.isLeaf(next.b) ||
                         (!c.treeA.isLeaf(next.a) && c.treeA.error(next.a) * static_cast<float>(c.poseA.scale) >=
                                                         c.treeB.error(next.b) * static_cast<float>(c.poseB.scale));
      const std::uint32_t children = intoA ? c.treeA.childCount(next.a) : c.treeB.childCount(next.b);
      ASSERT_LT(budget.remaining(), kSphereUpdateCost + children * kOverlapTestCost);
    }
  });
}

}  // namespace
}  // namespace cairn::staircase_test
