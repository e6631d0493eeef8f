// SPDX-License-Identifier: Zlib
#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/tree_pair_traversal.h"
#include "random_tree.h"

namespace cairn::front_error_test {
namespace {

float bruteForce(const Traversal& traversal) {
  float worst = 0;
  for (const NodePair& pair : traversal.front()) worst = std::max(worst, traversal.pairError(pair));
  return worst;
}

class FrontError : public testing::TestWithParam<std::uint64_t> {};

// Asked after every step, now and then, and across starts, moves and changes of scale.
TEST_P(FrontError, IsThatOfBruteForce) {
  std::mt19937_64 engine(GetParam());
  // Errors of a random tree fall from level to level; a real one's need not.
  SphereTreeData data = test::randomTree(GetParam()).data;
  for (NodeData& node : data.nodes) node.error = static_cast<float>(test::uniform(engine)) * 2 * node.radius;
  const SphereTree tree = std::move(SphereTree::create(data)).value();
  TreePairTraversal traversal;
  std::size_t compared = 0, rises = 0;
  for (int run = 0; run < 4; ++run) {
    const Pose pose = test::randomPose(engine, 0.5);
    Pose other = test::randomPose(engine, 0.5);
    traversal.start(tree, tree, pose, other, 0.02F);
    float last = traversal.worstFrontError();
    const std::uint64_t longest = run % 2 == 0 ? 10 : 300;
    for (int cut = 0; cut < 300 && !traversal.done(); ++cut) {
      Budget budget = Budget::operations(10 + engine() % longest);
      (void)traversal.refine(budget);
      if (engine() % 20 == 0) {
        other.scale *= 1.25;
        traversal.movePoses(pose, other);
      }
      if (engine() % 3 == 0) continue;  // not asked: what it missed it must catch up with
      const float worst = traversal.worstFrontError();
      ASSERT_EQ(worst, bruteForce(traversal)) << "run " << run << ", cut " << cut;
      rises += worst > last ? 1 : 0;
      last = worst;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50U);
  EXPECT_GT(rises, 0U) << "errors that only fall would not show much";
}

INSTANTIATE_TEST_SUITE_P(Seeds, FrontError, testing::Range<std::uint64_t>(1, 7));

}  // namespace
}  // namespace cairn::front_error_test
