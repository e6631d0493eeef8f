// SPDX-License-Identifier: Zlib
#include <gtest/gtest.h>

#include <tuple>

#include "cairn/core/obstacle_traversal.h"
#include "cairn/core/tree_pair_traversal.h"
#include "pair_case.h"
#include "random_tree.h"

namespace cairn::traversal_test {
namespace {

using test::expectEveryTouchReported;
using test::PairCase;
using test::PairSet;
using test::randomCase;
using test::setOf;
using test::treeOfOneBall;

// The answer of a traversal does not depend on the memory it holds.
void expectSameOnceFitted(Traversal& traversal) {
  const auto copyOf = [](std::span<const NodePair> pairs) { return std::vector(pairs.begin(), pairs.end()); };
  const auto said = [&] {
    return std::tuple(traversal.done(), copyOf(traversal.front()), copyOf(traversal.coarseFront()),
                      copyOf(traversal.leafPairs()), traversal.worstFrontError());
  };
  const auto before = said();
  traversal.shrinkToFit();
  EXPECT_EQ(said(), before);
}

// Products of float matrices turn and stretch a little: those of a tree four compounds deep by up to 35 units of 2^-24
// (hard case C1). A ball keeps its radius, so what it holds may be that much outside, however near the ball's centre is
// to the origin of its tree.
TEST(TreePairTraversal, PosesThatStretchLoseNoPointOfALargeBall) {
  constexpr double kOff = 35 * 0x1p-24;
  const auto stretched = [](double by) {
    Pose pose;
    for (int axis = 0; axis < 3; ++axis) pose.rotation.rows[axis] = pose.rotation.rows[axis] * by;
    return pose;
  };
  const Pose poseA = stretched(1 - kOff), poseB = stretched(1 + kOff);
  const double shared = poseB.rotation.rows[0].x / poseA.rotation.rows[0].x;  // B's (1, 0, 0) as A sees it
  const SphereTree a = treeOfOneBall({{static_cast<float>(shared), 0, 0}, 0x1p-24F}), b = treeOfOneBall({{}, 1});
  for (const bool isSwapped : {false, true}) {
    TreePairTraversal traversal;
    if (isSwapped)
      traversal.start(b, a, poseB, poseA, 0);
    else
      traversal.start(a, b, poseA, poseB, 0);
    EXPECT_EQ(traversal.leafPairs().size(), 1U) << "swapped " << isSwapped;
  }
}

TEST(TreePairTraversal, Unlimited_FindsEveryTouchAndOnlyOverlappingLeaves) {
  std::size_t touchingCases = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PairCase c = randomCase(seed, 1 + seed % 2);
    TreePairTraversal traversal;
    traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    Budget budget = Budget::unlimited();
    ASSERT_EQ(traversal.refine(budget), Progress::done);
    EXPECT_TRUE(traversal.front().empty());
    expectEveryTouchReported(c, traversal);
    const PairSet found = setOf(traversal.leafPairs());
    EXPECT_EQ(found.size(), traversal.leafPairs().size()) << "no pair is reported twice";
    const PairSet allowed = test::overlappingLeaves(c, 40 * kOverlapSlack);
    for (const auto& pair : found) EXPECT_TRUE(allowed.contains(pair));
    touchingCases += !found.empty();
  }
  EXPECT_GT(touchingCases, 20U) << "the cases must mostly touch to mean anything";
}

TEST(TreePairTraversal, StoppedAtEveryOperation_GivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PairCase c = randomCase(seed);
    TreePairTraversal whole;
    whole.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    Budget unlimited = Budget::unlimited();
    ASSERT_EQ(whole.refine(unlimited), Progress::done);

    for (std::uint64_t stop = 0; stop <= unlimited.used(); ++stop) {
      TreePairTraversal cut;
      cut.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
      Budget first = Budget::operations(stop);
      const Progress progress = cut.refine(first);
      ASSERT_LE(first.used(), stop);
      ASSERT_EQ(progress == Progress::done, cut.done());
      ASSERT_EQ(progress == Progress::done, stop >= unlimited.used());
      if (stop % 2 == 0) expectSameOnceFitted(cut);
      if (stop % 97 == 0) expectEveryTouchReported(c, cut);
      Budget rest = Budget::unlimited();
      ASSERT_EQ(cut.refine(rest), Progress::done);
      ASSERT_EQ(first.used() + rest.used(), unlimited.used());
      ASSERT_TRUE(std::equal(cut.leafPairs().begin(), cut.leafPairs().end(), whole.leafPairs().begin(),
                             whole.leafPairs().end()));
    }
  }
}

TEST(TreePairTraversal, StoppedAtEveryStep_GivesTheSameBits) {
  const PairCase c = randomCase(3);
  TreePairTraversal whole, stepwise;
  whole.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
  stepwise.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
  Budget unlimited = Budget::unlimited();
  ASSERT_EQ(whole.refine(unlimited), Progress::done);
  std::uint64_t used = 0, stops = 0;
  while (!stepwise.done()) {
    // The smallest budget that lets one step through, so that every step is a stop.
    for (std::uint64_t operations = 1;; ++operations) {
      Budget budget = Budget::operations(operations);
      (void)stepwise.refine(budget);
      used += budget.used();
      if (budget.used() > 0) break;
    }
    ++stops;
  }
  EXPECT_EQ(used, unlimited.used());
  EXPECT_GT(stops, 50U);
  EXPECT_EQ(setOf(stepwise.leafPairs()), setOf(whole.leafPairs()));
}

// Of each node the one above it; the root's is itself.
std::vector<NodeId> parentsOf(const SphereTree& tree) {
  std::vector<NodeId> parents(tree.families().size() * kFamilyWidth, kRootNode), waiting{kRootNode};
  while (!waiting.empty()) {
    const NodeId node = waiting.back();
    waiting.pop_back();
    if (tree.isLeaf(node)) continue;
    const NodeId first = tree.childFamily(node) * kFamilyWidth;
    for (NodeId child = first; child < first + tree.childCount(node); ++child) {
      parents[child] = node;
      waiting.push_back(child);
    }
  }
  return parents;
}

// The pair, or one of the nodes above it.
bool isIn(const PairSet& coarse, const NodePair& pair, const std::vector<NodeId>& aboveA,
          const std::vector<NodeId>& aboveB) {
  for (NodeId a = pair.a;; a = aboveA[a]) {
    for (NodeId b = pair.b;; b = aboveB[b]) {
      if (coarse.contains({a, b})) return true;
      if (b == kRootNode) break;
    }
    if (a == kRootNode) return false;
  }
}

TEST(TreePairTraversal, CoarseFront_HoldsAllTheFrontHolds) {
  std::size_t longest = 0, older = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PairCase c = randomCase(seed);
    const std::vector<NodeId> aboveA = parentsOf(c.treeA), aboveB = parentsOf(c.treeB);
    TreePairTraversal traversal;
    traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    while (!traversal.done()) {
      Budget turn = Budget::operations(80);
      (void)traversal.refine(turn);
      const PairSet coarse = setOf(traversal.coarseFront());
      ASSERT_LE(coarse.size(), Traversal::kCoarsePairs);
      for (const NodePair& pair : traversal.front()) ASSERT_TRUE(isIn(coarse, pair, aboveA, aboveB));
      longest = std::max(longest, traversal.front().size());
      older += traversal.front().size() > Traversal::kCoarsePairs ? 1 : 0;
    }
    ASSERT_TRUE(traversal.coarseFront().empty());
  }
  EXPECT_GT(older, 10U) << "at most " << longest << " pairs: the test shows nothing";
}

TEST(TreePairTraversal, ApartBodies_AreDismissedAtTheRoots) {
  PairCase c = randomCase(2);
  c.poseB.translation = c.poseA.translation + Vec3d(100, 0, 0);
  TreePairTraversal traversal;
  traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
  EXPECT_TRUE(traversal.done());
  EXPECT_TRUE(traversal.leafPairs().empty());
  EXPECT_EQ(traversal.worstError(), 0);
}

TEST(TreePairTraversal, FarFromTheOrigin_FindsTheSamePairs) {
  const PairCase c = randomCase(4);
  PairCase far = randomCase(4);
  const Vec3d offset(1 << 20, -(1 << 21), 1 << 19);  // exactly representable beside the poses' own digits
  far.poseA.translation += offset;
  far.poseB.translation += offset;
  TreePairTraversal near, away;
  near.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
  away.start(far.treeA, far.treeB, far.poseA, far.poseB, far.margin);
  Budget b1 = Budget::unlimited(), b2 = Budget::unlimited();
  ASSERT_EQ(near.refine(b1), Progress::done);
  ASSERT_EQ(away.refine(b2), Progress::done);
  EXPECT_EQ(setOf(near.leafPairs()), setOf(away.leafPairs()));
}

TEST(TreePairTraversal, AbsurdlyFarBodies_ReportOnlyNodesThatExist) {
  PairCase c = randomCase(4);
  for (const double away : {1e18, 1e25, 1e37}) {
    c.poseB.translation = {away, -away, away};
    TreePairTraversal traversal;
    traversal.start(c.treeA, c.treeB, c.poseA, c.poseB, c.margin);
    Budget budget = Budget::operations(100000);
    (void)traversal.refine(budget);
    for (const NodePair& p : traversal.leafPairs()) {
      ASSERT_LT(p.a % kFamilyWidth, c.treeA.familySize(p.a / kFamilyWidth)) << away;
      ASSERT_LT(p.b % kFamilyWidth, c.treeB.familySize(p.b / kFamilyWidth)) << away;
    }
  }
}

// Half-spaces as obstacles: the simplest thing whose answer is known in closed form.
class HalfSpaces final : public Obstacle {
 public:
  struct Plane {
    Vec3d normal;
    double offset;
  };
  explicit HalfSpaces(std::vector<Plane> planes) : planes_(std::move(planes)) {}
  std::uint32_t elementCount() const override { return static_cast<std::uint32_t>(planes_.size()); }
  std::uint32_t touches(const Family& family, std::uint32_t size, std::uint32_t element) const override {
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < size; ++lane)
      bits |= static_cast<std::uint32_t>(hits(family.sphere(lane), element)) << lane;
    return bits;
  }
  bool hits(const Sphere& s, std::uint32_t element) const {
    return dot(planes_[element].normal, Vec3d(s.center)) - planes_[element].offset <= s.radius;
  }
  bool below(const Vec3& p, std::uint32_t element) const {
    return dot(planes_[element].normal, Vec3d(p)) <= planes_[element].offset;
  }

 private:
  std::vector<Plane> planes_;
};

TEST(ObstacleTraversal, EveryPointBelowAPlane_IsInAReportedLeaf) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    test::RandomTree random = test::randomTree(seed);
    if (seed % 2 == 0) test::addBounds(random, seed);
    const SphereTree tree = std::move(SphereTree::create(random.data)).value();
    std::vector<HalfSpaces::Plane> planes;
    for (int i = 0; i < 3; ++i) planes.push_back({normalized(test::randomPoint(engine)), test::uniform(engine, -1, 1)});
    const HalfSpaces obstacle(planes);
    ObstacleTraversal traversal;
    traversal.start(tree, 2, obstacle);
    Budget budget = Budget::unlimited();
    ASSERT_EQ(traversal.refine(budget), Progress::done);
    PairSet found;
    for (const NodePair& p : traversal.leafPairs()) {
      EXPECT_EQ(traversal.mayTouch(p), obstacle.hits(tree.sphere(p.a), p.b));
      if (traversal.mayTouch(p)) found.insert({p.a, p.b});
    }
    for (std::uint32_t element = 0; element < 3; ++element)
      for (std::size_t i = 0; i < random.points.size(); ++i)
        if (obstacle.below(random.points[i], element))
          EXPECT_TRUE(found.contains({tree.nodeAt(random.leafOfPoint[i]), element})) << "seed " << seed;
    for (const NodePair& p : traversal.leafPairs()) EXPECT_TRUE(obstacle.hits(tree.bound(p.a), p.b));
    for (const NodePair& p : traversal.leafPairs())
      EXPECT_NEAR(traversal.pairError(p), 2 * tree.error(p.a), 2 * tree.error(p.a) * 0x1p-20F)
          << "world length: tree error times scale";
  }
}

// Errors are upper bounds: whatever a scale, a product and a sum round to, they may only grow, and hardly.
TEST(Traversal, PairErrors_AreNeverBelowTheNodesErrorsInTheWorld) {
  std::mt19937_64 engine(41);
  const SphereTree a = std::move(SphereTree::create(test::randomTree(41).data)).value();
  const SphereTree b = std::move(SphereTree::create(test::randomTree(42).data)).value();
  const HalfSpaces obstacle({{{0, 0, 1}, 0}});
  for (int round = 0; round < 100; ++round) {
    Pose poseA, poseB;
    poseA.scale = test::uniform(engine, 1e-3, 1);
    poseB.scale = test::uniform(engine, 1, 1e3);
    TreePairTraversal pairs;
    pairs.start(a, b, poseA, poseB, 0);
    ObstacleTraversal single;
    const auto scale = static_cast<float>(poseA.scale);
    single.start(a, scale, obstacle);
    for (NodeId node = 0; node < 9; ++node) {
      const NodeId inA = a.nodeAt(node), inB = b.nodeAt(8 - node);
      const double ofA = static_cast<double>(a.error(inA)), ofB = static_cast<double>(b.error(inB));
      const double both = ofA * poseA.scale + ofB * poseB.scale, one = ofA * static_cast<double>(scale);
      const auto stated = static_cast<double>(pairs.pairError({inA, inB}));
      EXPECT_GE(stated, both);
      EXPECT_LE(stated, both * (1 + 0x1p-20));
      EXPECT_GE(static_cast<double>(single.pairError({inA, 0})), one);
      EXPECT_LE(static_cast<double>(single.pairError({inA, 0})), one * (1 + 0x1p-20));
    }
  }
}

TEST(ObstacleTraversal, StoppedAtEveryOperation_GivesTheSameBits) {
  const SphereTree tree = std::move(SphereTree::create(test::randomTree(9).data)).value();
  const HalfSpaces obstacle({{{0, 0, 1}, 0.1}, {{1, 0, 0}, -0.3}});
  ObstacleTraversal whole;
  whole.start(tree, 1, obstacle);
  Budget unlimited = Budget::unlimited();
  ASSERT_EQ(whole.refine(unlimited), Progress::done);
  for (std::uint64_t stop = 0; stop <= unlimited.used(); ++stop) {
    ObstacleTraversal cut;
    cut.start(tree, 1, obstacle);
    Budget first = Budget::operations(stop), rest = Budget::unlimited();
    (void)cut.refine(first);
    if (stop % 2 == 0) expectSameOnceFitted(cut);
    ASSERT_EQ(cut.refine(rest), Progress::done);
    ASSERT_EQ(first.used() + rest.used(), unlimited.used());
    ASSERT_TRUE(
        std::equal(cut.leafPairs().begin(), cut.leafPairs().end(), whole.leafPairs().begin(), whole.leafPairs().end()));
  }
}

}  // namespace
}  // namespace cairn::traversal_test
