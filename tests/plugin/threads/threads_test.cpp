// SPDX-License-Identifier: Zlib
// Worlds whose pairs and islands are worked on by several threads: the same bits for any number of them.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolverMt.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h>
#include <LinearMath/btThreads.h>

#include <memory>
#include <vector>

#include "bullet_world.h"

namespace cairn::test::threads_test {
namespace {

btITaskScheduler* scheduler() {
  static btITaskScheduler* const made = btCreateDefaultTaskScheduler();
  return made;
}

// Bodies in a pile on a floor that is a tree, with Bullet's own between them.
class MtWorld {
 public:
  explicit MtWorld(int threads, std::optional<std::int64_t> operations) {
    btSetTaskScheduler(scheduler());
    scheduler()->setNumThreads(threads);
    dispatcher_ = std::make_unique<bullet::Dispatcher<btCollisionDispatcherMt>>(&configuration_, 1);
    pool_ = std::make_unique<btConstraintSolverPoolMt>(threads);
    world_ = std::make_unique<btDiscreteDynamicsWorldMt>(dispatcher_.get(), &broadphase_, pool_.get(), &solver_,
                                                         &configuration_);
    bullet::StepBudget budget;
    budget.operations = operations;
    EXPECT_TRUE(dispatcher_->setBudget(budget));
    fill();
  }
  ~MtWorld() {
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
    world_.reset();
  }

  std::uint64_t hashAfter(int steps) {
    StateHash hash;
    for (int i = 0; i < steps; ++i) world_->stepSimulation(btScalar(1.0 / 60), 0, btScalar(1.0 / 60));
    for (const auto& body : bodies_) addState(hash, *body);
    return hash.value();
  }
  bool isSane() const {
    for (const auto& body : bodies_)
      if (!test::isSane(*body)) return false;
    return true;
  }

 private:
  void fill() {
    add(treeShape(plainTree(cuboid({12, 12, 1}, 6))), 0, btVector3(0, 0, btScalar(-0.5)));
    const auto ring = treeShape(plainTree(torus(0.35, 0.12, 12)));
    const auto brick = treeShape(plainTree(cuboid({0.8, 0.4, 0.3}, 2)));
    const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.2)));
    for (int i = 0; i < 60; ++i) {
      const btVector3 at(btScalar(0.7) * btScalar(i % 4), btScalar(0.7) * btScalar(i / 4 % 4),
                         btScalar(0.5) + btScalar(0.6) * btScalar(i / 16));
      std::shared_ptr<btCollisionShape> shape = ring;
      if (i % 3 == 1) shape = brick;
      if (i % 7 == 3) shape = box;
      add(shape, 1, at);
    }
  }
  void add(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform.setOrigin(at);
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_->addRigidBody(bodies_.back().get());
  }

  btDefaultCollisionConfiguration configuration_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolverMt solver_;
  std::unique_ptr<bullet::Dispatcher<btCollisionDispatcherMt>> dispatcher_;
  std::unique_ptr<btConstraintSolverPoolMt> pool_;
  std::unique_ptr<btDiscreteDynamicsWorldMt> world_;
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

TEST(Threads, BulletIsThreadSafe) {
  ASSERT_NE(scheduler(), nullptr) << "this Bullet was built without BT_THREADSAFE";
  EXPECT_GT(scheduler()->getMaxNumThreads(), 1);
}

TEST(Threads, SameBitsForAnyNumberOfThreadsUnderABudget) {
  for (const std::optional<std::int64_t> operations :
       {std::optional<std::int64_t>(), std::optional<std::int64_t>(5000)}) {
    const std::uint64_t alone = MtWorld(1, operations).hashAfter(120);
    for (const int threads : {1, 2, 4})
      for (int run = 0; run < 2; ++run)
        EXPECT_EQ(MtWorld(threads, operations).hashAfter(120), alone)
            << threads << " threads, " << operations.value_or(-1) << " operations, run " << run;
  }
}

TEST(Threads, NothingIsLostWhenBodiesComeAndGo) {
  for (int round = 0; round < 3; ++round) {
    MtWorld w(4, 2000);
    w.hashAfter(60);
    EXPECT_TRUE(w.isSane());
  }
}

}  // namespace
}  // namespace cairn::test::threads_test
