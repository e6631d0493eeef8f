// SPDX-License-Identifier: Zlib
// The effect of a budget on a scene: nobody lost, nothing exploded, and the same bits every time.
#include <gtest/gtest.h>

#include "cairn/core/tree_pair_traversal.h"
#include "walled_heap.h"

namespace cairn::test::budget_test {
namespace {

using bullet::Unresolved;

// The flattest body is 0.3 m thick: with its centre no deeper than this it is at least two thirds out.
constexpr btScalar kSunk = btScalar(0.05);

struct Heap : WalledHeap {
  using WalledHeap::WalledHeap;

  void expectNobodyLost() const {
    for (const btRigidBody* body : bodies) {
      ASSERT_TRUE(isSane(*body));
      const btVector3& p = body->getWorldTransform().getOrigin();
      EXPECT_GT(p.z(), kSunk) << "sank into the ground";
      EXPECT_LT(std::max(std::abs(p.x()), std::abs(p.y())), 1 - kSunk) << "sank into a wall";
    }
  }
};

// The highest body starts at 4 m: falling freely it arrives with less than 9 m/s. Faster means that something pushed.
constexpr btScalar kFreeFallSpeed = 9;

// And in builds of other compilers and levels: tests/golden_hash/compare.sh.
TEST(Budget_GoldenHash, IsThatOfAnyBuild) {
  const std::uint64_t hash = goldenHash();
  EXPECT_EQ(hash, kGoldenHash) << std::hex << "0x" << hash;
}

class BudgetedHeap : public testing::TestWithParam<std::optional<std::int64_t>> {};

TEST_P(BudgetedHeap, LosesNobodyAndDoesNotExplode) {
  Heap heap(GetParam());
  heap.run(300);
  heap.expectNobodyLost();
  EXPECT_LT(heap.peakSpeed, kFreeFallSpeed);
}

TEST_P(BudgetedHeap, GivesTheSameBitsTwice) {
  Heap first(GetParam()), second(GetParam());
  first.run(120);
  second.run(120);
  EXPECT_EQ(first.w.stateHash(), second.w.stateHash());
}

INSTANTIATE_TEST_SUITE_P(Budgets, BudgetedHeap,
                         testing::Values(std::optional<std::int64_t>(0), 1, 100, 2000, 20000,
                                         std::optional<std::int64_t>()));

class BudgetedExactHeap : public testing::TestWithParam<std::optional<std::int64_t>> {};

TEST_P(BudgetedExactHeap, LosesNobodyAndGivesTheSameBitsTwice) {
  Heap first(GetParam()), second(GetParam());
  std::uint64_t exact = 0;
  for (Heap* heap : {&first, &second}) heap->w.dispatcher.setFinest(bullet::Finest::triangles);
  for (int i = 0; i < 30; ++i) {
    first.run(10);
    second.run(10);
    exact += first.w.dispatcher.lastStep().exactContacts;
  }
  EXPECT_EQ(first.w.stateHash(), second.w.stateHash());
  first.expectNobodyLost();
  EXPECT_LT(first.peakSpeed, kFreeFallSpeed);
  if (GetParam().value_or(20000) >= 20000) {
    EXPECT_GT(exact, 0U) << "nothing went on to triangles: the test shows nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Budgets, BudgetedExactHeap,
                         testing::Values(std::optional<std::int64_t>(0), 2000, 20000, std::optional<std::int64_t>()));

TEST(Budget_None, NothingFallsThroughAPlane) {
  Heap heap(0);
  heap.run(30);
  EXPECT_GT(heap.w.dispatcher.lastStep().unresolvedPairs, 0U) << "the budget was no limit: the test shows nothing";
  for (btRigidBody* body : heap.bodies) body->setActivationState(DISABLE_DEACTIVATION);
  heap.run(600);
  heap.expectNobodyLost();
}

// An answer that was once complete must not let a body creep away from it for ever.
TEST(Budget_None, HoldsABodyThatHadRestedBefore) {
  BulletWorld<> w;
  w.addGround();
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.3, 6))), 1, btVector3(0, 0, btScalar(0.31)));
  w.step(120);
  ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  body.activate(true);
  body.setActivationState(DISABLE_DEACTIVATION);
  body.setAngularVelocity(btVector3(0, 3, 0));
  w.step(600);
  EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.15);
}

// The end it stands on does not close in while the other one falls: what a slow traversal had ruled out does.
TEST(Budget_Starved, ARodThatTipsOverStaysAboveTheGround) {
  for (const std::int64_t operations : {45, 60, 80}) {
    SCOPED_TRACE(operations);
    BulletWorld<> w;
    w.addGround();
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    btRigidBody& rod = w.add(treeShape(plainTree(cuboid({3, 0.3, 0.3}, 3))), 1, btVector3(0, 0, btScalar(1.38)));
    rod.getWorldTransform().setRotation(btQuaternion(btVector3(0, 1, 0), SIMD_PI / 3));
    btScalar lowest = 0;
    for (int step = 0; step < 400; ++step) {
      w.step();
      for (int corner = 0; corner < 8; ++corner) {
        const btVector3 p(corner & 1 ? btScalar(1.5) : btScalar(-1.5), corner & 2 ? btScalar(0.15) : btScalar(-0.15),
                          corner & 4 ? btScalar(0.15) : btScalar(-0.15));
        lowest = std::min(lowest, (rod.getWorldTransform() * p).z());
      }
    }
    EXPECT_GT(lowest, -0.3) << "sank by more than its thickness";
    EXPECT_LT(rod.getWorldTransform().getOrigin().z(), 1.3) << "did not tip over: the test shows nothing";
  }
}

TEST(Budget_Operations, AreNotExceededByRefinement) {
  Heap limited(5000), unlimited(std::nullopt);
  std::uint64_t peak = 0;
  for (int i = 0; i < 120; ++i) {
    limited.w.step();
    unlimited.w.step();
    peak = std::max(peak, unlimited.w.dispatcher.lastStep().operations);
    // The cost of measuring contacts is held back while refining, up to what the last turn finds: eight families of
    // eight leaves, five operations each. On top comes what stands in for unfinished pairs: re-tests of 32 known pairs,
    // and the spheres of 128 pairs of the front and of whole bodies, three operations each.
    const auto& s = limited.w.dispatcher.lastStep();
    EXPECT_LE(s.operations, 5000U + 64U * 5U + s.unresolvedPairs * (32U * 5U + 129U * 3U)) << "step " << i;
  }
  EXPECT_GT(peak, 5000U) << "the limit never bit: the test shows nothing";
}

TEST(Budget_Time, ZeroMicrosecondsStillHoldsTheHeap) {
  Heap heap(std::nullopt);
  ASSERT_TRUE(heap.w.dispatcher.setBudget({{}, 0.0}).ok());
  heap.run(120);
  heap.expectNobodyLost();
}

TEST(Budget_Policies, AllStayFinite) {
  for (const Unresolved policy : {Unresolved::guard, Unresolved::repel, Unresolved::ignore, Unresolved::compensate}) {
    Heap heap(1500, policy);
    heap.run(180);
    for (const btRigidBody* body : heap.bodies) EXPECT_TRUE(isSane(*body)) << static_cast<int>(policy);
  }
}

TEST(Budget_Statistics, SayWhatHappened) {
  Heap heap(std::nullopt);
  heap.run(240);
  const auto& s = heap.w.dispatcher.lastStep();
  int contacts = 0, manifolds = 0;
  for (int i = 0; i < heap.w.dispatcher.getNumManifolds(); ++i) {
    const int count = heap.w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
    contacts += count;
    manifolds += count > 0;
  }
  EXPECT_EQ(s.unresolvedPairs, 0U);
  EXPECT_GT(s.pairs, 24U);
  EXPECT_LE(s.contacts, static_cast<std::uint32_t>(contacts));
  EXPECT_GT(s.contacts, 24U);
  EXPECT_LE(s.manifolds, static_cast<std::uint32_t>(manifolds));
  EXPECT_GT(s.microseconds, 0);
  EXPECT_GT(s.worstErrorFraction, 0);
  EXPECT_LE(s.meanErrorFraction, s.worstErrorFraction);
}

// A pair that stays silent is the worst answer of all, not the best.
TEST(Budget_Statistics, CountTheErrorOfPairsThatSayNothing) {
  for (const Unresolved policy : {Unresolved::ignore, Unresolved::guard}) {
    BulletWorld<> w;
    w.addGround();
    w.add(treeShape(plainTree(ball(0.3, 6))), 1, btVector3(0, 0, btScalar(0.295)));
    w.dispatcher.setUnresolved(policy);
    ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
    w.world.performDiscreteCollisionDetection();
    const double unrefined = w.dispatcher.lastStep().worstErrorFraction;
    EXPECT_GT(unrefined, 0) << static_cast<int>(policy);
    EXPECT_EQ(w.dispatcher.lastStep().unresolvedPairs, 1U);
    ASSERT_TRUE(w.dispatcher.setBudget({}).ok());
    w.world.performDiscreteCollisionDetection();
    EXPECT_LT(w.dispatcher.lastStep().worstErrorFraction, unrefined);
  }
}

TEST(Budget_Statistics, AreFiniteAgainstAPoint) {
  BulletWorld<> w;
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, 0));
  w.add(std::make_shared<btSphereShape>(btScalar(0)), 1, btVector3(0, 0, btScalar(0.501)));
  w.world.performDiscreteCollisionDetection();
  const auto& s = w.dispatcher.lastStep();
  EXPECT_GE(s.contacts, 1U) << "1 mm away, within the speculative distance of the tree's size";
  EXPECT_TRUE(std::isfinite(s.worstErrorFraction));
  EXPECT_TRUE(std::isfinite(s.meanErrorFraction));
}

// Two balls deep in each other: many leaf pairs, and a long front while unfinished.
struct DeepPair {
  BulletWorld<> w;
  std::shared_ptr<const SphereTree> tree = plainTree(ball(0.5, 20));

  DeepPair() {
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(treeShape(tree), 1, btVector3(0, 0, 0));
    w.add(treeShape(tree), 1, btVector3(btScalar(0.05), 0, 0));
  }
  std::uint64_t detect(std::optional<std::int64_t> operations) {
    EXPECT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    w.world.performDiscreteCollisionDetection();
    return w.dispatcher.lastStep().operations;
  }
};

TEST(Budget_Statistics, CountTheContactsOfFinishedTraversals) {
  DeepPair pair;
  const std::uint64_t charged = pair.detect({});
  TreePairTraversal traversal;
  Pose moved;
  moved.translation = Vec3d(0.05, 0, 0);
  traversal.start(*pair.tree, *pair.tree, Pose{}, moved, 0);
  Budget budget = Budget::unlimited();
  traversal.refine(budget);
  ASSERT_GT(traversal.leafPairs().size(), 1000U);
  EXPECT_GE(charged, budget.used() + 5 * traversal.leafPairs().size());
}

TEST(Budget_Policies, LookAtNoMoreThanTheHeadOfALongFront) {
  for (const Unresolved policy : {Unresolved::guard, Unresolved::repel, Unresolved::ignore, Unresolved::compensate}) {
    DeepPair pair;
    pair.w.dispatcher.setUnresolved(policy);
    pair.detect(20000);
    EXPECT_EQ(pair.w.dispatcher.lastStep().unresolvedPairs, 1U) << "finished: the test shows nothing";
    EXPECT_LE(pair.detect(0), 32U * 5U + 128U * 3U) << "policy " << static_cast<int>(policy);
  }
}

}  // namespace
}  // namespace cairn::test::budget_test
