// SPDX-License-Identifier: Zlib
// Contacts that slow bodies keep from step to step must equal those of a new world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "bullet_world.h"
#include "cairn/core/scheduler.h"
#include "contacts/relative_placement.h"
#include "counting_new.h"
#include "installed_dispatchers.h"
#include "pairs/contact_cache.h"
#include "test_solids.h"

namespace cairn::test::contact_cache_test {
namespace {

constexpr unsigned kSeed = 20;

double uniform(std::mt19937_64& engine, double from, double to) {
  return from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

btVector3 direction(std::mt19937_64& engine) {
  btVector3 v;
  do {
    v.setValue(btScalar(uniform(engine, -1, 1)), btScalar(uniform(engine, -1, 1)), btScalar(uniform(engine, -1, 1)));
  } while (v.length2() > 1 || v.length2() < btScalar(0.01));
  return v.normalized();
}

btTransform nudged(const btTransform& pose, double by, std::mt19937_64& engine) {
  const btQuaternion turn(direction(engine), btScalar(uniform(engine, 0, by)));
  const btVector3 shift = direction(engine) * btScalar(uniform(engine, 0, by));
  return btTransform(turn * pose.getRotation(), pose.getOrigin() + shift);
}

TEST(Displacement, BoundsHowFarAnyPointOfTheBallHasMoved) {
  std::mt19937_64 engine(kSeed);
  btScalar tightest = 0;
  for (int i = 0; i < 2000; ++i) {
    bullet::RelativePlacement before, now;
    before.center = now.center = direction(engine) * btScalar(uniform(engine, 0, 2));
    before.radius = now.radius = btScalar(uniform(engine, 0.1, 2));
    before.treeInOther = btTransform(btQuaternion(direction(engine), btScalar(uniform(engine, 0, 6))),
                                     direction(engine) * btScalar(uniform(engine, 0, 100)));
    now.treeInOther = nudged(before.treeInOther, i % 2 ? 3 : 0.01, engine);
    const btScalar bound = now.displacementSince(before);
    for (int k = 0; k < 20; ++k) {
      const btVector3 p = now.center + direction(engine) * now.radius;
      const btScalar moved = (now.treeInOther * p - before.treeInOther * p).length();
      ASSERT_LE(moved, bound) << "seed " << kSeed << ", case " << i;
      tightest = std::max(tightest, moved / bound);
    }
  }
  EXPECT_GT(tightest, 0.9) << "the bound is far from what it bounds";
}

/// A body next to one that stays, in a world of its own.
struct Two {
  BulletWorld<> w;
  btRigidBody* moving = nullptr;

  Two(std::shared_ptr<const SphereTree> fixedTree, std::shared_ptr<const SphereTree> tree, const btTransform& pose) {
    w.add(treeShape(std::move(fixedTree)), 0, btVector3(0, 0, 0));
    w.add(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(-0.3)), 0, btVector3(0, 0, 0));
    moving = &w.add(treeShape(std::move(tree)), 1, pose.getOrigin(), pose.getRotation());
    moving->setActivationState(DISABLE_DEACTIVATION);
  }

  void detectAt(const btTransform& pose) {
    moving->setWorldTransform(pose);
    w.world.performDiscreteCollisionDetection();
  }

  void setFinest(bullet::Finest finest) { w.dispatcher.setFinest(finest); }

  // Of the contacts with another body; nothing without one.
  std::optional<btScalar> deepest(int otherBody) const {
    std::optional<btScalar> least;
    btDispatcher& dispatcher = const_cast<BulletWorld<>&>(w).dispatcher;
    const btCollisionObject* other = w.world.getCollisionObjectArray()[otherBody];
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *dispatcher.getManifoldByIndexInternal(i);
      if (m.getBody0() != other && m.getBody1() != other) continue;
      for (int k = 0; k < m.getNumContacts(); ++k)
        least = std::min(least.value_or(BT_LARGE_FLOAT), m.getContactPoint(k).getDistance());
    }
    return least;
  }
};

class ContactCacheOf : public ::testing::TestWithParam<bullet::Finest> {};

TEST_P(ContactCacheOf, IsWhatAFreshWorldFinds) {
  const bool isExact = GetParam() == bullet::Finest::triangles;
  constexpr double kSize = 0.71;  // of the smaller body
  // A contact that is held stays chosen until another is deeper by a quarter of the speculative distance, 0.2 % of the
  // size; what triangles said holds until the bodies have moved by a tenth of that distance.
  const btScalar held = btScalar((isExact ? 0.35 : 0.25) * 0.002 * kSize);
  // Deeper than minima are trusted the overlap's shape says how deep it is: no bound, but that there is something.
  const btScalar deepest = btScalar(isExact ? -0.02 * kSize : -BT_LARGE_FLOAT);
  // Leaves that are not flat: those of flat ones share a normal that is kept over steps.
  const auto fixed = plainTree(torus(0.3, 0.12, 30), 8), tree = plainTree(torus(0.25, 0.1, 28), 8);
  std::mt19937_64 engine(kSeed);
  std::uint64_t kept = 0, fresh = 0;
  int contacts = 0;
  for (int start = 0; start < 60; ++start) {
    btTransform pose(btQuaternion(direction(engine), btScalar(uniform(engine, 0, 6))),
                     direction(engine) * btScalar(uniform(engine, 0.25, 0.6)));
    Two lasting(fixed, tree, pose);
    lasting.setFinest(GetParam());
    for (int step = 0; step < 25; ++step) {
      pose = nudged(pose, 2e-4, engine);
      lasting.detectAt(pose);
      Two newborn(fixed, tree, pose);
      newborn.setFinest(GetParam());
      newborn.detectAt(pose);
      kept += lasting.w.dispatcher.lastStep().operations;
      fresh += newborn.w.dispatcher.lastStep().operations;
      for (const int other : {0, 1}) {
        const auto expected = newborn.deepest(other), found = lasting.deepest(other);
        ASSERT_EQ(found.has_value(), expected.has_value())
            << "seed " << kSeed << ", start " << start << ", step " << step << ", body " << other;
        if (!expected) continue;
        ++contacts;
        if (*expected < deepest) continue;
        EXPECT_NEAR(*found, *expected, held)
            << "seed " << kSeed << ", start " << start << ", step " << step << ", body " << other;
      }
    }
  }
  EXPECT_GT(contacts, 500);
  EXPECT_LT(2 * kept, fresh) << "nothing was kept: the test shows nothing";
}
INSTANTIATE_TEST_SUITE_P(All, ContactCacheOf, ::testing::Values(bullet::Finest::leaves, bullet::Finest::triangles));

// One leap that velocities do not tell of, after many small steps.
TEST(ContactCache, LapsesWhenABodyIsSetElsewhere) {
  const auto tree = plainTree(ball(0.3, 6));
  Two two(tree, tree, btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 1)));
  const auto touchesAt = [&](double x) {
    two.detectAt(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), 0, 0)));
    return two.deepest(0).has_value();
  };
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(touchesAt(0.65));
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(touchesAt(0.55));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(touchesAt(0.65));
}

// A pair ruled out at one end of a motion is not ruled out at the other.
TEST(ContactCache, OfATraversalThatWasMovedOn_DoesNotHoldWhereItBegan) {
  for (const std::int64_t operations : {0, 10, 20, 40}) {
    const auto tree = plainTree(cuboid({1, 1, 1}, 4));
    const auto at = [](double z) { return btTransform(btQuaternion::getIdentity(), btVector3(3, 0, btScalar(z))); };
    Two two(tree, tree, at(2));
    ASSERT_TRUE(two.w.dispatcher.setBudget({operations, {}}).ok());
    two.detectAt(at(0.1));
    ASSERT_GT(two.w.dispatcher.lastStep().unresolvedPairs, 0U) << "the budget was no limit: the test shows nothing";
    ASSERT_TRUE(two.w.dispatcher.setBudget({}).ok());
    two.detectAt(at(0.54));
    EXPECT_EQ(two.w.dispatcher.lastStep().unresolvedPairs, 0U);
    for (int i = 0; i < 3; ++i) two.detectAt(at(0.1));
    EXPECT_TRUE(two.deepest(1).has_value()) << operations;
  }
}

// The same tree, turned about another origin: the body's pose is the same, its surface is elsewhere.
TEST(ContactCache, LapsesWithTheBodysFrame) {
  Solid solid = cuboid({0.5, 0.5, 0.5}, 3);
  for (Vec3d& v : solid.vertices) v.z += 2;
  const auto tree = plainTree(solid);
  auto centred = bullet::SphereTreeShape::create(tree, bullet::BodyFrame::principalAxes);
  ASSERT_TRUE(centred.ok());
  const std::unique_ptr<bullet::SphereTreeShape> shape = std::move(centred).value();
  const btTransform pose(btQuaternion::getIdentity(), btVector3(3, 0, btScalar(-0.2)));
  Two two(plainTree(ball(0.1, 3)), tree, pose);
  for (int i = 0; i < 5; ++i) two.detectAt(pose);
  EXPECT_FALSE(two.deepest(1).has_value());
  two.moving->setCollisionShape(shape.get());
  two.detectAt(pose);
  EXPECT_TRUE(two.deepest(1).has_value());
}

// A guard was put up where the answer was too old; it must go when there is nothing.
TEST(ContactCache, ThatNothingTouches_LeavesNoGuard) {
  const auto tree = plainTree(cuboid({0.8, 0.8, 0.8}, 4));
  const btTransform pose(btQuaternion::getIdentity(), btVector3(btScalar(0.05), 0, 2));
  Two two(plainTree(twoCuboids({0.3, 0.3, 0.3}, {2, 0, 0}, 3)), tree, pose);
  const btTransform between(btQuaternion::getIdentity(), btVector3(btScalar(0.05), 0, btScalar(0.15)));
  two.w.world.getDispatchInfo().m_timeStep = btScalar(1.0 / 60);
  two.moving->setLinearVelocity(btVector3(btScalar(0.2), 0, 0));
  ASSERT_TRUE(two.w.dispatcher.setBudget({0, {}}).ok());
  for (int i = 0; i < 5; ++i) two.detectAt(between);
  ASSERT_TRUE(two.w.dispatcher.setBudget({}).ok());
  for (int i = 0; i < 5; ++i) two.detectAt(between);
  EXPECT_FALSE(two.deepest(0).has_value());
}

// Nobody moves, yet what touches changes.
TEST(ContactCache, LapsesWithTheMargin) {
  const auto tree = plainTree(ball(0.3, 6));
  const btTransform pose(btQuaternion::getIdentity(), btVector3(btScalar(0.65), 0, 0));
  Two two(tree, tree, pose);
  for (int i = 0; i < 10; ++i) two.detectAt(pose);
  EXPECT_FALSE(two.deepest(0).has_value());
  two.moving->getCollisionShape()->setMargin(btScalar(0.1));
  two.detectAt(pose);
  EXPECT_TRUE(two.deepest(0).has_value());
}

// A tile with more leaf pairs than a step can measure is let down on another, so slowly that what is known of them is
// kept. That nothing touched is no answer to what has come near since: where it says that it is resolved, what overlaps
// has contacts.
TEST(ContactCache, OfMoreLeafPairsThanAStepMeasuresIsNotSilent) {
  constexpr double kApart = 0.0022, kStep = 0.00005;  // of the size; nothing is within reach at first
  const auto tile = treeShape(plainTree(cuboid({1, 1, 0.1}, 16)));
  const double size = static_cast<double>(tile->size());
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  w.add(tile, 0, btVector3(0, 0, 0));
  btRigidBody& upper = w.add(tile, 1, btVector3(0, 0, btScalar(0.1 + kApart * size)));
  w.world.performDiscreteCollisionDetection();
  EXPECT_TRUE(w.dispatcher.setBudget({2000, {}}).ok());
  int resolved = 0;
  for (double separation = kApart; separation > -0.01; separation -= kStep) {
    upper.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.1 + separation * size))));
    w.world.performDiscreteCollisionDetection();
    const bullet::StepStatistics& step = w.dispatcher.lastStep();
    if (separation >= 0 || step.unresolvedPairs > 0) continue;
    ++resolved;
    EXPECT_GT(step.contacts, 0U) << separation;
  }
  EXPECT_GT(resolved, 50) << "the answer is not kept";
}

// A flat tile on a ball: most of its leaf pairs are measured in vain. Measuring all of them again, to know which are
// not near, costs several times what a step needs, and is planned like everything else.
TEST(ContactCache, IsNotMeasuredAllOverAgainBeyondTheBudget) {
  constexpr int kPairs = 10, kSteps = 400, kCells = 16;
  const auto tile = treeShape(plainTree(cuboid({1, 1, 0.1}, kCells)));
  const auto round = treeShape(plainTree(ball(0.5, kCells)));
  BulletWorld<> w;
  w.dispatcher.setFinest(bullet::Finest::leaves);
  w.world.setGravity(btVector3(0, 0, 0));
  std::vector<btRigidBody*> tiles;
  for (int i = 0; i < kPairs; ++i) {
    w.add(round, 0, btVector3(btScalar(3 * i), 0, 0));
    tiles.push_back(&w.add(tile, 1, btVector3(btScalar(3 * i), 0, btScalar(0.55))));
  }
  // Up and down by a thousandth of the size: what is known of the leaf pairs is kept.
  const auto operationsOf = [&](int step) {
    const double depth = (0.0012 + 0.0008 * std::sin(0.02 * step)) * double(tile->size());
    for (btRigidBody* body : tiles) {
      const btVector3 at(body->getWorldTransform().getOrigin().x(), 0, btScalar(0.55 - depth));
      body->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    }
    w.world.performDiscreteCollisionDetection();
    return w.dispatcher.lastStep().operations;
  };
  std::vector<std::uint64_t> free;
  for (int step = 0; step < kSteps; ++step) free.push_back(operationsOf(step));
  std::ranges::sort(free);
  const std::uint64_t budget = 2 * free[free.size() / 2];
  ASSERT_GT(free.back(), 2 * budget) << "all are never measured again";
  ASSERT_TRUE(w.dispatcher.setBudget({static_cast<std::int64_t>(budget), {}}).ok());
  for (int step = 0; step < kSteps; ++step) ASSERT_LE(operationsOf(step), budget) << "step " << step;
}

// Ten tiles that lie flat on others cost as much as what touches alone. The step in which they move, or lose contact,
// asks about all of each, which is planned at that price. Returns the most operations of a step on a budget of 800.
std::uint64_t mostOfTilesAt(double apart, const btVector3& moved, int every) {
  constexpr int kPairs = 10, kSteps = 100;
  constexpr std::int64_t kBudget = 800;  // four times what they need while they lie still
  const auto tile = treeShape(plainTree(cuboid({1, 1, 0.1}, 16)));
  const double size = double(tile->size());
  BulletWorld<> w;
  w.dispatcher.setFinest(bullet::Finest::leaves);
  w.world.setGravity(btVector3(0, 0, 0));
  std::vector<btRigidBody*> tiles;
  for (int i = 0; i < kPairs; ++i) {
    w.add(tile, 0, btVector3(btScalar(3 * i), 0, 0));
    tiles.push_back(&w.add(tile, 1, btVector3(btScalar(3 * i), 0, btScalar(0.1 + apart * size))));
  }
  for (int step = 0; step < 20; ++step) w.world.performDiscreteCollisionDetection();
  EXPECT_LT(w.dispatcher.lastStep().operations, std::uint64_t(kBudget) / 2)
      << "all is asked about while they lie still";
  EXPECT_TRUE(w.dispatcher.setBudget({kBudget, {}}).ok());
  std::uint64_t most = 0;
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < kPairs; ++i) {
      const btVector3 at(btScalar(3 * i), 0, btScalar(0.1 + apart * size));
      const btVector3 by = step / every % 2 == 0 ? btVector3(0, 0, 0) : moved * btScalar(size);
      tiles[std::size_t(i)]->setWorldTransform(btTransform(btQuaternion::getIdentity(), at + by));
    }
    w.world.performDiscreteCollisionDetection();
    most = std::max(most, w.dispatcher.lastStep().operations);
  }
  return most;
}

TEST(ContactCache, OfWhatLayStillIsPlannedInFullOnceItMoves) {
  constexpr std::uint64_t kMax = 800 + Scheduler::kTurnOperations;
  for (const int every : {1, 3, 10}) {
    EXPECT_LE(mostOfTilesAt(-0.001, btVector3(btScalar(0.003), 0, 0), every), kMax) << "aside, every " << every;
    EXPECT_LE(mostOfTilesAt(0.0019, btVector3(0, 0, btScalar(0.0003)), every), kMax) << "up, every " << every;
  }
}

const btCollisionObject* leftOut = nullptr;

void leavingOneOut(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  if (leftOut && (pair.m_pProxy0->m_clientObject == leftOut || pair.m_pProxy1->m_clientObject == leftOut)) return;
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

// A user who asks about a pair in every second step only: where the steps' ends are not told, its traversal is done in
// the steps in which nobody asks. It is measured when somebody does: it is neither kept unmeasured, nor begun again.
TEST(ContactCache, OfATraversalNobodyAskedAboutIsMeasuredWhenAsked) {
  constexpr int kSteps = 100;
  const auto tile = treeShape(plainTree(cuboid({1, 1, 0.1}, 8))),
             cube = treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2)));
  const double size = double(tile->size());
  BulletWorld<InstalledOnDispatcher> w;
  w.world.setGravity(btVector3(0, 0, 0));
  w.dispatcher.setNearCallback(leavingOneOut);
  for (const btScalar x : {btScalar(10), btScalar(13)}) {
    w.add(cube, 0, btVector3(x, 0, 0));
    w.add(cube, 1, btVector3(x, 0, btScalar(0.499)));
  }
  w.add(tile, 0, btVector3(0, 0, 0));
  const btRigidBody& upper = w.add(tile, 1, btVector3(btScalar(0.02), btScalar(0.01), btScalar(0.1 - 0.002 * size)));
  ASSERT_TRUE(w.dispatcher.setBudget({30000, {}}).ok());
  int resolved = 0;
  for (int step = 0; step < kSteps; ++step) {
    leftOut = step % 2 == 0 ? nullptr : &upper;
    w.world.performDiscreteCollisionDetection();
    if (!leftOut && w.dispatcher.lastStep().unresolvedPairs == 0) ++resolved;
  }
  leftOut = nullptr;
  EXPECT_GT(resolved, kSteps / 4);
}

// A pair picked before room is made is still there afterwards; one picked later needs no room.
TEST(ContactCache, PicksAFewWithoutAllocating) {
  std::vector<NodePair> pairs;
  for (std::uint32_t i = 0; i < 56; ++i) pairs.push_back({i, i});
  const bullet::RelativeMotion still;
  bullet::ContactCache before, after;
  before.select(pairs, still, {}, bullet::RefreshPolicy::allIfFew);
  before.makeRoom(pairs.size());
  std::uint32_t sum = 0;
  for (const NodePair& pair : before.near()) sum += pair.a;
  EXPECT_EQ(sum, 27U * 28U) << "every second of 56";
  after.makeRoom(40);
  after.makeRoom(pairs.size());
  const std::size_t allocated = allocations();
  after.select(pairs, still, {}, bullet::RefreshPolicy::allIfFew);
  EXPECT_EQ(allocations(), allocated);
  EXPECT_EQ(after.near().size(), 28U);
}

}  // namespace
}  // namespace cairn::test::contact_cache_test
