// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolverMt.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h>
#include <LinearMath/btThreads.h>

#include <memory>
#include <optional>
#include <vector>

#include "bullet_world.h"

namespace cairn::test {

/// Null where Bullet was built without `BT_THREADSAFE`.
inline btITaskScheduler* threadScheduler() {
  static btITaskScheduler* const made = btCreateDefaultTaskScheduler();
  return made;
}

/// A Bullet world whose pairs and islands are worked on by so many threads, owning what is put into it.
class MtWorld {
 public:
  MtWorld(int threads, std::optional<std::int64_t> operations) {
    btSetTaskScheduler(threadScheduler());
    threadScheduler()->setNumThreads(threads);
    dispatcher_ = std::make_unique<bullet::Dispatcher<btCollisionDispatcherMt>>(&configuration_, 1);
    pool_ = std::make_unique<btConstraintSolverPoolMt>(threads);
    world_ = std::make_unique<btDiscreteDynamicsWorldMt>(dispatcher_.get(), &broadphase_, pool_.get(), &solver_,
                                                         &configuration_);
    world_->setGravity(btVector3(0, 0, btScalar(-9.81)));
    bullet::StepBudget budget;
    budget.operations = operations;
    EXPECT_TRUE(dispatcher_->setBudget(budget));
  }
  ~MtWorld() {
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
    world_.reset();
  }

  /// Mass 0: static. An inertia of nothing: the shape's own.
  btRigidBody& add(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btTransform& at,
                   btVector3 inertia = btVector3(0, 0, 0)) {
    if (mass > 0 && inertia.isZero()) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform = at;
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_->addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }
  btRigidBody& add(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btVector3& at) {
    return add(std::move(shape), mass, btTransform(btQuaternion::getIdentity(), at));
  }
  void remove(btRigidBody& body) {
    world_->removeRigidBody(&body);
    std::erase_if(bodies_, [&](const auto& owned) { return owned.get() == &body; });
  }

  void step(int steps = 1) {
    for (int i = 0; i < steps; ++i) world_->stepSimulation(btScalar(1.0 / 60), 0, btScalar(1.0 / 60));
  }
  std::uint64_t stateHash() const {
    StateHash hash;
    for (const auto& body : bodies_) addState(hash, *body);
    return hash.value();
  }
  bool isSane() const {
    for (const auto& body : bodies_)
      if (!test::isSane(*body)) return false;
    return true;
  }
  btRigidBody& body(std::size_t i) { return *bodies_[i]; }
  std::size_t bodies() const { return bodies_.size(); }
  btDiscreteDynamicsWorldMt& world() { return *world_; }
  bullet::Dispatcher<btCollisionDispatcherMt>& dispatcher() { return *dispatcher_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolverMt solver_;
  std::unique_ptr<bullet::Dispatcher<btCollisionDispatcherMt>> dispatcher_;
  std::unique_ptr<btConstraintSolverPoolMt> pool_;
  std::unique_ptr<btDiscreteDynamicsWorldMt> world_;
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;  // outlive what Bullet remembers of them
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace cairn::test
