// SPDX-License-Identifier: Zlib
// The motion of a heap depends neither on events far away nor on earlier bodies.
#include "cairn/bullet/ordered_solver.h"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "bullet_world.h"
#include "test_trees.h"

namespace cairn::test::ordered_solver_test {
namespace {

struct Elsewhere {
  bool hasIsland = false, hadBody = false, splitsIslands = true;
};

// Rings and bricks, which touch in several places each, and boxes of Bullet's between them.
class Heap {
 public:
  explicit Heap(const Elsewhere& elsewhere) {
    w_.world.setConstraintSolver(&solver_);
    w_.world.getSimulationIslandManager()->setSplitIslands(elsewhere.splitsIslands);
    addFloor(btVector3(0, 0, 0));
    if (elsewhere.hadBody) passing_ = &w_.add(ring_, 1, btVector3(500, 0, 10));
    fill(heap_, btVector3(0, 0, 0));
    if (!elsewhere.hasIsland) return;
    addFloor(btVector3(1000, 0, 0));
    fill(others_, btVector3(1000, 0, btScalar(0.1)));
  }

  void step() {
    w_.step();
    if (passing_ && ++steps_ == kPassing) w_.remove(*std::exchange(passing_, nullptr));
  }
  std::uint64_t state() const {
    StateHash hash;
    for (const btRigidBody* body : heap_) addState(hash, *body);
    return hash.value();
  }
  // Manifolds with points beyond the first one of their pair.
  int furtherManifolds() {
    int further = 0;
    std::set<std::pair<const void*, const void*>> pairs;
    for (int i = 0; i < w_.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w_.dispatcher.getManifoldByIndexInternal(i);
      EXPECT_EQ(m.m_index1a, i) << "Bullet finds it there to release it";
      if (m.getNumContacts() > 0 && !pairs.insert({m.getBody0(), m.getBody1()}).second) ++further;
    }
    return further;
  }

 private:
  static constexpr int kPassing = 40;

  void addFloor(const btVector3& at) {
    w_.add(std::make_shared<btBoxShape>(btVector3(9, 9, 1)), 0, at - btVector3(0, 0, 1));
  }
  void fill(std::vector<btRigidBody*>& bodies, const btVector3& place) {
    const auto brick = treeShape(plainTree(cuboid({0.8, 0.4, 0.3}, 6)));
    const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.2)));
    for (int i = 0; i < 18; ++i) {
      const btVector3 at(btScalar(0.5) * btScalar(i % 3), btScalar(0.4) * btScalar(i / 3 % 2),
                         btScalar(0.4) + btScalar(0.5) * btScalar(i / 6));
      std::shared_ptr<btCollisionShape> shape = ring_;
      if (i % 3 == 1) shape = brick;
      if (i % 7 == 3) shape = box;
      bodies.push_back(&w_.add(shape, 1, place + at));
    }
  }

  bullet::OrderedSolver<> solver_;
  BulletWorld<> w_;
  std::shared_ptr<btCollisionShape> ring_ = treeShape(plainTree(torus(0.35, 0.12, 32)));
  std::vector<btRigidBody*> heap_, others_;
  btRigidBody* passing_ = nullptr;
  int steps_ = 0;
};

class OrderedSolver : public testing::TestWithParam<Elsewhere> {};

TEST_P(OrderedSolver, AHeapDoesTheSameWhateverIsElsewhere) {
  Elsewhere nothing = GetParam();
  nothing.hasIsland = nothing.hadBody = false;
  Heap alone(nothing), beside(GetParam());
  int further = 0;
  for (int i = 0; i < 240; ++i) {
    alone.step();
    beside.step();
    further += alone.furtherManifolds();
    ASSERT_EQ(alone.state(), beside.state()) << "step " << i;
  }
  EXPECT_GT(further, 240) << "hardly a pair has several manifolds: the test shows nothing";
}

INSTANTIATE_TEST_SUITE_P(Elsewhere, OrderedSolver,
                         testing::Values(Elsewhere{.hasIsland = true}, Elsewhere{.hadBody = true},
                                         Elsewhere{.hasIsland = true, .splitsIslands = false},
                                         Elsewhere{.hadBody = true, .splitsIslands = false}));

}  // namespace
}  // namespace cairn::test::ordered_solver_test
