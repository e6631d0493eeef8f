// SPDX-License-Identifier: Zlib
// Worlds of Bullet's own kind, whose pairs with a sphere-tree are worked on by the threads of a task scheduler: the
// same bits for any number of them.
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "collider_shapes.h"
#include "pile.h"
#include "thread_scheduler.h"

namespace cairn::test {
namespace {

using World = BulletWorld<>;

// Trees on everything they can lie on, and everything that moves on a tree, each ground by itself. Every third mover
// looks ahead.
void fillWithEverything(World& w) {
  constexpr btScalar kApart = 300;  // round grounds are a hundred metres wide
  const auto treeOf = [](const Solid& solid) { return plainTree(solid); };
  const std::vector<TriedMover> movers = everyMover(treeOf);
  int place = 0;
  for (const TriedGround& ground : everyGround(treeOf)) {
    const btVector3 at(kApart * btScalar(place++), 0, 0);
    w.add(ground.shape, 0, at - btVector3(0, 0, ground.top), ground.turned);
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const bool hasTree = movers[i].name.find("tree") != std::string::npos || ground.name == "tree";
      const btVector3 over(btScalar(1.5) * btScalar(i % 4) - 2, btScalar(1.5) * btScalar(i / 4) - 2, btScalar(0.5));
      if (!hasTree) continue;
      btRigidBody& body = w.add(movers[i].body.shape, 1, at + over, movers[i].turned);
      if (w.world.getNumCollisionObjects() % 3 == 0) body.setCcdMotionThreshold(btScalar(0.02));
    }
  }
}

void fillHeap(World& w) {
  w.addGround();
  for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
    w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-1)), 0, btVector3(0, 0, 0));
  const auto ring = treeShape(plainTree(torus(0.35, 0.12, 12)));
  const auto brick = treeShape(plainTree(cuboid({0.8, 0.4, 0.3}, 2)));
  for (int i = 0; i < 60; ++i)
    w.add(i % 3 == 1 ? brick : ring, 1,
          btVector3(btScalar(0.45) * btScalar(i % 4) - btScalar(0.7),
                    btScalar(0.45) * btScalar(i / 4 % 4) - btScalar(0.7),
                    btScalar(0.5) + btScalar(0.5) * btScalar(i / 16)));
}

struct Ended {
  std::uint64_t hash = 0;
  std::uint64_t operations = 0;  // of all steps
  double errors = 0;             // mean certified errors, summed

  friend bool operator==(const Ended&, const Ended&) = default;
};

Ended endOf(const std::function<void(World&)>& fill, std::optional<std::int64_t> operations, int steps) {
  World w;
  EXPECT_TRUE(w.dispatcher.setBudget({operations, {}}));
  fill(w);
  Ended ended;
  std::uint32_t contacts = 0;
  for (int i = 0; i < steps; ++i) {
    w.step();
    const bullet::StepStatistics& last = w.dispatcher.lastStep();
    ended.operations += last.operations;
    ended.errors += last.meanErrorFraction;
    contacts = std::max(contacts, last.contacts);
  }
  EXPECT_GT(contacts, 60U) << "few touch: the test shows little";
  ended.hash = w.stateHash();
  return ended;
}

void expectSameBits(const std::function<void(World&)>& fill, int steps) {
  for (const std::optional<std::int64_t> operations :
       {std::optional<std::int64_t>(), std::optional<std::int64_t>(2000), std::optional<std::int64_t>(20000)}) {
    SCOPED_TRACE(testing::Message() << operations.value_or(-1) << " operations");
    const Ended alone = endOf(fill, operations, steps);
    for (const int threads : {1, 2, 4}) {
      ThreadScheduler scheduler(threads);
      EXPECT_EQ(endOf(fill, operations, steps), alone) << threads << " threads";
      EXPECT_EQ(scheduler.loops > 0, threads > 1) << threads << " threads";
    }
  }
}

TEST(WorkerThreads, EndAHeapWhereOneThreadDoes) {
  expectSameBits(fillHeap, 150);
}

TEST(WorkerThreads, AnswerForEverythingATreeMeetsAsOneThreadDoes) {
  expectSameBits(fillWithEverything, 40);
}

// Users' callbacks see the pairs in their order, from the thread that steps the world.
std::vector<std::pair<int, int>> gTold;
std::thread::id gStepping;

bool noteBodies(btManifoldPoint&, const btCollisionObjectWrapper* a, int, int, const btCollisionObjectWrapper* b, int,
                int) {
  EXPECT_EQ(std::this_thread::get_id(), gStepping);
  gTold.emplace_back(a->getCollisionObject()->getBroadphaseHandle()->m_uniqueId,
                     b->getCollisionObject()->getBroadphaseHandle()->m_uniqueId);
  return false;
}

std::vector<std::pair<int, int>> toldIn(int steps) {
  World w;
  fillHeap(w);
  for (int i = 0; i < w.world.getNumCollisionObjects(); ++i) {
    btCollisionObject* const body = w.world.getCollisionObjectArray()[i];
    body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  }
  gTold.clear();
  gStepping = std::this_thread::get_id();
  gContactAddedCallback = noteBodies;
  w.step(steps);
  gContactAddedCallback = nullptr;
  return gTold;
}

TEST(WorkerThreads, LeaveCallbacksToTheCallingThread) {
  const std::vector<std::pair<int, int>> alone = toldIn(60);
  ASSERT_GT(alone.size(), 1000U);
  ThreadScheduler scheduler(4);
  EXPECT_EQ(toldIn(60), alone);
}

}  // namespace
}  // namespace cairn::test
