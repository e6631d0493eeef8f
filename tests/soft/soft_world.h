// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/soft/soft_contacts.h"
#include "solid_oracle.h"
#include "test_trees.h"

namespace cairn::test {

inline constexpr btScalar kStep = btScalar(1) / 60;

/// A world of soft bodies and sphere-trees that owns what is put into it.
class SoftWorld {
 public:
  explicit SoftWorld(const btVector3& gravity = {0, 0, btScalar(-9.81)})
      : dispatcher(&configuration_),
        contacts(soft::SoftContacts::install(dispatcher).value()),
        world(&dispatcher, &broadphase_, &solver_, &configuration_) {
    world.setGravity(gravity);
    world.getWorldInfo().m_gravity = gravity;
    world.getWorldInfo().m_sparsesdf.Initialize();
  }
  ~SoftWorld() {
    for (const auto& soft : softs_) world.removeSoftBody(soft.get());
    for (const auto& body : bodies_) world.removeRigidBody(body.get());
  }

  /// Mass 0: fixed.
  btRigidBody& add(std::shared_ptr<btCollisionShape> shape, btScalar mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform = pose;
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }
  /// Moved by nobody but its mesh.
  btRigidBody& addKinematic(std::shared_ptr<btCollisionShape> shape) {
    btRigidBody& body = add(std::move(shape), 0, btTransform::getIdentity());
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    return body;
  }
  btSoftBody& add(btSoftBody* soft, btScalar mass) {
    soft->setTotalMass(mass);
    softs_.emplace_back(soft);
    world.addSoftBody(soft);
    return *soft;
  }
  /// A square cloth around the middle, `pinned` at its corners or free.
  btSoftBody& addCloth(const btVector3& middle, btScalar halfWidth, int cells, btScalar mass, bool pinned) {
    const auto corner = [&](int x, int y) {
      return middle + btVector3(btScalar(x) * halfWidth, btScalar(y) * halfWidth, 0);
    };
    btSoftBody* const cloth =
        btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), corner(-1, -1), corner(1, -1), corner(-1, 1), corner(1, 1),
                                       cells + 1, cells + 1, pinned ? 15 : 0, true);
    cloth->getCollisionShape()->setMargin(kMargin);
    cloth->m_cfg.piterations = 20;
    cloth->m_cfg.kKHR = 1;  // Bullet gives nodes back a tenth of their depth in fixed bodies unless told otherwise
    return add(cloth, mass);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.stepSimulation(kStep, 0);
  }

  static constexpr btScalar kMargin = btScalar(0.01);  // of cloths, metres

 private:
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;

 public:
  bullet::Dispatcher<> dispatcher;
  soft::SoftContacts contacts;
  btSoftRigidDynamicsWorld world;

 private:
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btSoftBody>> softs_;
};

inline std::shared_ptr<bullet::SphereTreeShape> treeShape(const Solid& solid, btScalar scale = 1) {
  return bullet::SphereTreeShape::create(plainTree(solid), bullet::BodyFrame::mesh, scale).value();
}

/// How deep the deepest node is in a tree's mesh, by brute force; negative where all are outside.
inline double deepestNode(const btSoftBody& soft, const bullet::SphereTreeShape& shape, const btTransform& pose) {
  const SphereTree& tree = shape.tree();
  const SolidOracle oracle{tree.vertices(), tree.triangles()};
  double deepest = -1e9;
  for (int i = 0; i < soft.m_nodes.size(); ++i) {
    const btVector3 p = (pose * shape.bodyFromTree()).invXform(soft.m_nodes[i].m_x) / shape.scale();
    const Vec3d point{double(p.x()), double(p.y()), double(p.z())};
    const double distance = oracle.toSurface(point) * double(shape.scale());
    deepest = std::max(deepest, oracle.windingNumber(point) > 0.5 ? distance : -distance);
  }
  return deepest;
}

inline btTransform at(btScalar x, btScalar y, btScalar z) {
  return btTransform(btQuaternion::getIdentity(), {x, y, z});
}

inline double lowest(const btSoftBody& soft) {
  double z = 1e9;
  for (int i = 0; i < soft.m_nodes.size(); ++i) z = std::min(z, double(soft.m_nodes[i].m_x.z()));
  return z;
}

}  // namespace cairn::test
