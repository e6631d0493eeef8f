// SPDX-License-Identifier: Zlib
#include "node_contacts.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "placement/bullet_math.h"

namespace cairn::soft {

namespace {

/// A tree's mesh in the world, and the body that carries it.
struct PlacedMesh {
  const bullet::SphereTreeShape& shape;
  btTransform pose;  // of the tree's frame, without its scale
  const btCollisionObject& object;
  btRigidBody* rigid;  // null for another kind of object

  Vec3 toTree(const btVector3& point) const { return bullet::toVec3(pose.invXform(point) / shape.scale()); }
};

PlacedMesh placed(const btCollisionObjectWrapper& wrapper) {
  const auto& shape = *static_cast<const bullet::SphereTreeShape*>(wrapper.getCollisionShape());
  const btCollisionObject& object = *wrapper.getCollisionObject();
  // Bullet's soft solver, too, pushes what it was shown as constant.
  return {shape, wrapper.getWorldTransform() * shape.bodyFromTree(), object,
          const_cast<btRigidBody*>(btRigidBody::upcast(&object))};
}

/// The contact as Bullet's solver for soft bodies wants it: btSoftColliders::CollideSDF_RS has the same fields.
btSoftBody::RContact contactOf(btSoftBody& soft, btSoftBody::Node& node, const PlacedMesh& mesh,
                               const NodeBarrier& barrier, btScalar margin) {
  btSoftBody::RContact contact;
  const btVector3 normal = mesh.pose.getBasis() * bullet::toBtVector3(barrier.normal);
  contact.m_cti.m_colObj = &mesh.object;
  contact.m_cti.m_normal = normal;
  contact.m_cti.m_offset = btScalar(barrier.separation) * mesh.shape.scale() - margin - normal.dot(node.m_x);
  const btScalar step = soft.m_sst.sdt;
  const btVector3 arm = node.m_x - mesh.object.getWorldTransform().getOrigin();
  const btVector3 ofBody = mesh.rigid ? mesh.rigid->getVelocityInLocalPoint(arm) * step : btVector3(0, 0, 0);
  const btVector3 motion = node.m_x - node.m_q - ofBody;
  const btScalar along = motion.dot(normal);
  const btScalar friction = soft.m_cfg.kDF * mesh.object.getFriction();
  const btMatrix3x3 inverseInertia =
      mesh.rigid ? mesh.rigid->getInvInertiaTensorWorld() : btMatrix3x3(0, 0, 0, 0, 0, 0, 0, 0, 0);
  contact.m_node = &node;
  contact.m_c0 = ImpulseMatrix(step, node.m_im, mesh.rigid ? mesh.rigid->getInvMass() : 0, inverseInertia, arm);
  contact.m_c1 = arm;
  contact.m_c2 = node.m_im * step;
  contact.m_c3 = (motion - normal * along).length2() < along * along * friction * friction ? 0 : 1 - friction;
  contact.m_c4 = mesh.object.isStaticOrKinematicObject() ? soft.m_cfg.kKHR : soft.m_cfg.kCHR;
  return contact;
}

bool canMove(const btSoftBody::Node& node, const PlacedMesh& mesh) {
  return !node.m_battach && node.m_im + (mesh.rigid ? mesh.rigid->getInvMass() : 0) > 0;
}

}  // namespace

void NodeContacts::processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                                    const btDispatcherInfo&, btManifoldResult*) {
  const PlacedMesh mesh = placed(*(isTreeFirst_ ? body0 : body1));
  // As Bullet's own algorithms for soft bodies do it, which write contacts into an object they were shown as constant.
  auto& soft = const_cast<btSoftBody&>(*btSoftBody::upcast((isTreeFirst_ ? body1 : body0)->getCollisionObject()));
  const SurfaceView surface = mesh.shape.tree().surfaceView();
  const btScalar margin = soft.getCollisionShape()->getMargin() + mesh.shape.getMargin();
  const auto inTree = static_cast<float>(margin / mesh.shape.scale());
  guesses_.resize(static_cast<std::size_t>(soft.m_nodes.size()), 0);
  bool touches = false;
  for (int i = 0; i < soft.m_nodes.size(); ++i) {
    btSoftBody::Node& node = soft.m_nodes[i];
    if (!canMove(node, mesh)) continue;
    const auto barrier = search_.find(surface, mesh.toTree(node.m_q), mesh.toTree(node.m_x), inTree,
                                      guesses_[static_cast<std::size_t>(i)]);
    if (!barrier) continue;
    soft.m_rcontacts.push_back(contactOf(soft, node, mesh, *barrier, margin));
    touches = true;
  }
  if (touches && mesh.rigid) mesh.rigid->activate();
}

}  // namespace cairn::soft
