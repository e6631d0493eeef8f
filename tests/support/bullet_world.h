// SPDX-License-Identifier: Zlib
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/state_hash.h"
#include "test_trees.h"

namespace cairn::test {

/// Where a body stands and how it moves on.
inline void addState(StateHash& hash, const btRigidBody& body) {
  const btTransform& t = body.getWorldTransform();
  for (int i = 0; i < 3; ++i) {
    hash.add(t.getOrigin()[i]);
    hash.add(body.getLinearVelocity()[i]);
    for (int j = 0; j < 3; ++j) hash.add(t.getBasis()[i][j]);
  }
}

/// A Bullet world with our dispatcher (or another), owning what is put into it. A dispatcher that can attach itself to
/// the world does so.
template <class DispatcherType = bullet::Dispatcher<>>
class BulletWorld {
 public:
  BulletWorld() : dispatcher(&configuration_), world(&dispatcher, &broadphase_, &solver_, &configuration_) {
    world.setGravity(btVector3(0, 0, btScalar(-9.81)));
    if constexpr (requires(DispatcherType d, btDiscreteDynamicsWorld w) { d.attach(w); }) dispatcher.attach(world);
  }
  ~BulletWorld() {
    if constexpr (requires(DispatcherType d) { d.detach(); }) dispatcher.detach();
    while (world.getNumCollisionObjects() > 0) {
      btCollisionObject* object = world.getCollisionObjectArray()[world.getNumCollisionObjects() - 1];
      world.removeCollisionObject(object);
    }
  }

  /// Mass 0: static.
  btRigidBody& add(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btVector3& position,
                   const btQuaternion& rotation = btQuaternion::getIdentity()) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform = btTransform(rotation, position);
    info.m_friction = btScalar(0.5);
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }
  void remove(btRigidBody& body) {
    world.removeRigidBody(&body);
    std::erase_if(bodies_, [&](const auto& owned) { return owned.get() == &body; });
  }
  btRigidBody& addGround() {
    return add(std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), 0, btVector3(0, 0, 0));
  }

  void step(int count = 1) {
    for (int i = 0; i < count; ++i) world.stepSimulation(btScalar(1.0 / 60), 0);
  }

  std::uint64_t stateHash() const {
    StateHash hash;
    for (const auto& body : bodies_) addState(hash, *body);
    return hash.value();
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;

 public:
  DispatcherType dispatcher;
  btDiscreteDynamicsWorld world;
};

inline std::shared_ptr<bullet::SphereTreeShape> treeShape(std::shared_ptr<const SphereTree> tree, btScalar scale = 1) {
  auto shape = bullet::SphereTreeShape::create(std::move(tree), bullet::BodyFrame::mesh, scale);
  if (!shape) throw std::runtime_error(shape.error().message);
  return std::move(shape).value();
}

// J/kg, of motion and height.
inline double energyPerMass(const btRigidBody& body) {
  const btVector3 &speed = body.getLinearVelocity(), &inverse = body.getInvInertiaDiagLocal();
  const btVector3 spin = body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity();
  double turning = 0;
  for (int i = 0; i < 3; ++i) turning += double(spin[i] * spin[i] / inverse[i]);
  return 0.5 * (double(speed.length2()) + turning * double(body.getInvMass())) -
         double(body.getGravity().z() * body.getWorldTransform().getOrigin().z());
}

inline bool isSane(const btRigidBody& body) {
  const btVector3& p = body.getWorldTransform().getOrigin();
  const btVector3& v = body.getLinearVelocity();
  return std::isfinite(p.x() + p.y() + p.z() + v.x() + v.y() + v.z() + body.getAngularVelocity().length());
}

}  // namespace cairn::test
