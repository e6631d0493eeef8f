// SPDX-License-Identifier: Zlib
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "cairn/core/obstacle_traversal.h"
#include "cairn/core/tree_pair_traversal.h"
#include "random_tree.h"

namespace cairn::traversal_test {
namespace {

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

PairSet setOf(std::span<const NodePair> pairs) {
  PairSet set;
  for (const NodePair& p : pairs) set.insert({p.a, p.b});
  return set;
}

struct PairCase {
  test::RandomTree a, b;
  SphereTree treeA, treeB;
  Pose poseA, poseB;
  float margin;
};

PairCase randomCase(std::uint64_t seed, std::uint32_t spheresPerNode = 1) {
  std::mt19937_64 engine(seed);
  test::RandomTree a = test::randomTree(seed * 2, 300, 3);
  test::RandomTree b = test::randomTree(seed * 2 + 1, 200, static_cast<std::uint32_t>(1 + engine() % 3));
  if (spheresPerNode == 2)
    for (test::RandomTree* tree : {&a, &b}) test::addBounds(*tree, seed);
  SphereTree treeA = std::move(SphereTree::create(a.data)).value();
  SphereTree treeB = std::move(SphereTree::create(b.data)).value();
  const Pose poseA = test::randomPose(engine, 1.2);
  const Pose poseB = test::randomPose(engine, 1.2);
  return {std::move(a), std::move(b), std::move(treeA), std::move(treeB), poseA, poseB, 0.05F};
}

// The promise of any stop: two points of the bodies closer than the margin lie in a reported pair that may touch.
void expectEveryTouchReported(const PairCase& c, const Traversal& traversal) {
  PairSet reported;
  for (const auto& pairs : {traversal.leafPairs(), traversal.front()})
    for (const NodePair& p : pairs)
      if (traversal.mayTouch(p)) reported.insert({p.a, p.b});
  const auto isReported = [&](std::uint32_t recordA, std::uint32_t recordB) {
    for (std::uint32_t a = recordA;; a = c.treeA.data().nodes[a].parent) {
      for (std::uint32_t b = recordB;; b = c.treeB.data().nodes[b].parent) {
        if (reported.contains({c.treeA.nodeAt(a), c.treeB.nodeAt(b)})) return true;
        if (b == 0) break;
      }
      if (a == 0) return false;
    }
  };
  for (std::size_t i = 0; i < c.a.points.size(); ++i)
    for (std::size_t j = 0; j < c.b.points.size(); ++j) {
      const double separation = distance(c.poseA * Vec3d(c.a.points[i]), c.poseB * Vec3d(c.b.points[j]));
      if (separation <= c.margin) ASSERT_TRUE(isReported(c.a.leafOfPoint[i], c.b.leafOfPoint[j])) << i << ", " << j;
    }
}

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

// In the world, in double; negative where they overlap.
double gapOf(const PairCase& c, const Sphere& a, const Sphere& b) {
  const double reach = a.radius * c.poseA.scale + b.radius * c.poseB.scale + c.margin;
  return distance(c.poseA * Vec3d(a.center), c.poseB * Vec3d(b.center)) - reach;
}

// Brute force: all pairs of leaves whose bounds overlap, no hierarchy.
PairSet overlappingLeaves(const PairCase& c, double slack) {
  PairSet set;
  for (const NodeId a : c.treeA.levelCut(c.treeA.depth()))
    for (const NodeId b : c.treeB.levelCut(c.treeB.depth()))
      if (gapOf(c, c.treeA.bound(a), c.treeB.bound(b)) <= slack) set.insert({a, b});
  return set;
}

SphereTree treeOfOneBall(const Sphere& ball, std::vector<Sphere> bounds = {}) {
  SphereTreeData data;
  data.bounds = std::move(bounds);
  NodeData& node = data.nodes.emplace_back();
  node.center = ball.center;
  node.radius = ball.radius;
  node.supportCount = 1;
  node.triangleCount = 4;
  data.supportPoints = {ball.center};
  test::detail::addTetrahedron(data);
  return std::move(SphereTree::create(std::move(data))).value();
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
    const PairSet allowed = overlappingLeaves(c, 40 * kOverlapSlack);
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

// Bounds decide which pairs are found, in which order and at what cost, as if they were all there is; which node of a
// pair is split, and what a pair certifies, is said by the errors of the spheres.
TEST(TreePairTraversal, TwoSpheresANode_FindsWhatTheBoundsAloneFind) {
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

TEST(TreePairTraversal, TwoSpheresANode_RootsMeetByTheirBounds) {
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
TEST(TreePairTraversal, TwoSpheresANode_AnswersWithTheSpheresAtEveryStop) {
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
