// SPDX-License-Identifier: Zlib
// Two spheres a node: the one bounds, the other answers.
#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/tree_pair_traversal.h"
#include "pair_case.h"

namespace cairn::test::two_spheres_test {
namespace {

// Bounds decide which pairs are found, in which order and at what cost, as if they were all there is; which node of a
// pair is split, and what a pair certifies, is said by the errors of the spheres.
TEST(TwoSpheresANode, FindsWhatTheBoundsAloneFind) {
  std::size_t pairs = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PairCase c = randomCase(seed, 2);
    const auto boundsAlone = [](SphereTreeData data) {
      for (std::size_t i = 0; i < data.nodes.size(); ++i) {
        data.nodes[i].center = data.bounds[i].center;
        data.nodes[i].radius = data.bounds[i].radius;
      }
      data.bounds.clear();
      return std::move(SphereTree::create(std::move(data))).value();
    };
    const SphereTree a = boundsAlone(c.a.data), b = boundsAlone(c.b.data);
    TreePairTraversal two, one;
    two.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    one.start(a, b, c.poseA, c.poseB, c.margin);
    while (!two.done()) {
      Budget ofTwo = Budget::operations(100), ofOne = Budget::operations(100);
      ASSERT_EQ(two.refine(ofTwo), one.refine(ofOne));
      ASSERT_EQ(ofTwo.used(), ofOne.used());
      ASSERT_TRUE(std::ranges::equal(two.front(), one.front()));
      ASSERT_EQ(two.worstFrontError(), one.worstFrontError());
    }
    ASSERT_TRUE(std::ranges::equal(two.leafPairs(), one.leafPairs()));
    pairs += two.leafPairs().size();
  }
  EXPECT_GT(pairs, 1000U) << "the cases must mostly touch to mean anything";
}

TEST(TwoSpheresANode, RootsMeetByTheirBounds) {
  const SphereTree largeBound = treeOfOneBall({{}, 1}, {{{}, 2}}), largeSphere = treeOfOneBall({{}, 2}, {{{}, 1}});
  Pose away;
  away.translation = {3.5, 0, 0};
  for (const SphereTree* tree : {&largeBound, &largeSphere}) {
    TreePairTraversal traversal;
    traversal.start(*tree, *tree, {}, away, 0);
    const bool isFound = tree == &largeBound;
    ASSERT_EQ(traversal.leafPairs().size(), isFound ? 1U : 0U);
    if (isFound) EXPECT_FALSE(traversal.mayTouch(traversal.leafPairs()[0])) << "its spheres are apart";
  }
}

// Wherever it is stopped: what touches is reported by a pair whose spheres touch too, and a pair says so as brute force
// does.
TEST(TwoSpheresANode, AnswersWithTheSpheresAtEveryStop) {
  std::size_t touching = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PairCase c = randomCase(seed, 2);
    const double slack = 40 * double(kOverlapSlack);
    TreePairTraversal traversal;
    traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    for (bool isDone = traversal.done(); !isDone; isDone = traversal.done()) {
      Budget budget = Budget::operations(150);
      (void)traversal.refine(budget);
      expectEveryTouchReported(c, traversal);
      for (const auto& pairs : {traversal.front(), traversal.leafPairs()})
        for (const NodePair& p : pairs) {
          const double gap = gapOf(c, c.treeA.sphere(p.a), c.treeB.sphere(p.b));
          const bool mayTouch = traversal.mayTouch(p);
          if (std::abs(gap) > slack) ASSERT_EQ(mayTouch, gap < 0);
          ++(mayTouch ? touching : apart);
        }
    }
  }
  EXPECT_GT(touching, 1000U);
  EXPECT_GT(apart, 100U) << "no pair is ruled out by its spheres: the test shows nothing";
}

}  // namespace
}  // namespace cairn::test::two_spheres_test
