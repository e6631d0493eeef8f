// SPDX-License-Identifier: Zlib
#include "soft_pair.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include <algorithm>
#include <optional>

#include "placement/bullet_math.h"

namespace cairn::soft {

namespace {

/// The body that carries a mesh.
struct Carrier {
  const btCollisionObject& object;
  btRigidBody* rigid;  // null for another kind of object

  // Bullet's soft solver, too, pushes what it was shown as constant.
  explicit Carrier(const btCollisionObject* of)
      : object(*of), rigid(const_cast<btRigidBody*>(btRigidBody::upcast(of))) {}
  btScalar inverseMass() const { return rigid ? rigid->getInvMass() : 0; }
};

/// The contact as Bullet's solver for soft bodies wants it: btSoftColliders::CollideSDF_RS has the same fields.
btSoftBody::RContact contactOf(btSoftBody& soft, btSoftBody::Node& node, const Carrier& carrier,
                               const btVector3& normal, btScalar separation) {
  btSoftBody::RContact contact;
  contact.m_cti.m_colObj = &carrier.object;
  contact.m_cti.m_normal = normal;
  contact.m_cti.m_offset = separation - normal.dot(node.m_x);
  const btScalar step = soft.m_sst.sdt;
  const btVector3 arm = node.m_x - carrier.object.getWorldTransform().getOrigin();
  const btVector3 ofBody = carrier.rigid ? carrier.rigid->getVelocityInLocalPoint(arm) * step : btVector3(0, 0, 0);
  const btVector3 motion = node.m_x - node.m_q - ofBody;
  const btScalar along = motion.dot(normal);
  const btScalar friction = soft.m_cfg.kDF * carrier.object.getFriction();
  const btMatrix3x3 inverseInertia =
      carrier.rigid ? carrier.rigid->getInvInertiaTensorWorld() : btMatrix3x3(0, 0, 0, 0, 0, 0, 0, 0, 0);
  contact.m_node = &node;
  contact.m_c0 = ImpulseMatrix(step, node.m_im, carrier.inverseMass(), inverseInertia, arm);
  contact.m_c1 = arm;
  contact.m_c2 = node.m_im * step;
  contact.m_c3 = (motion - normal * along).length2() < along * along * friction * friction ? 0 : 1 - friction;
  contact.m_c4 = carrier.object.isStaticOrKinematicObject() ? soft.m_cfg.kKHR : soft.m_cfg.kCHR;
  return contact;
}

/// Bullet's solver passes over nodes that move out of a body by themselves, however deep they are. The surface of a
/// mesh that moves may be faster, and the solver does not know its speed: such a node is put onto the surface here.
void liftOut(btSoftBody::Node& node, const btVector3& normal, btScalar depth) {
  const bool movesOut = (node.m_x - node.m_q).dot(normal) > 0;
  if (node.m_im > 0 && depth > 0 && movesOut) node.m_x += normal * depth;
}

bool isSameMeshMoved(const SphereTree& first, const SphereTree& second) {
  return first.vertices().size() == second.vertices().size() &&
         std::ranges::equal(first.triangles(), second.triangles());
}

}  // namespace

Vec3 PlacedMesh::toTree(const btVector3& point) const {
  return bullet::toVec3(pose.invXform(point) / scale);
}

void SoftPair::follow(const PlacedMesh& mesh, std::size_t nodes) {
  const bool isNew = !now_.tree || (now_.tree != mesh.tree && !isSameMeshMoved(*now_.tree, *mesh.tree));
  if (isNew) tracks_.clear();
  before_ = isNew ? mesh : now_;
  now_ = mesh;
  if (before_.tree != now_.tree)
    for (NodeTrack& track : tracks_) track.clearance = 0;
  tracks_.resize(nodes);
}

Vec3 SoftPair::startOf(const btSoftBody::Node& node, const NodeTrack& track) const {
  const Vec3 start = before_.toTree(node.m_q);
  if (before_.tree == now_.tree) return start;
  return carried(start, before_.tree->surfaceView(), now_.tree->surfaceView(), track.triangle);
}

void SoftPair::meet(btSoftBody& soft, const btCollisionObjectWrapper& tree, const bullet::SphereTreeShape& shape) {
  follow({shape.sharedTree(), tree.getWorldTransform() * shape.bodyFromTree(), shape.scale()},
         static_cast<std::size_t>(soft.m_nodes.size()));
  const Carrier carrier(tree.getCollisionObject());
  const SurfaceView surface = now_.tree->surfaceView();
  const btScalar margin = soft.getCollisionShape()->getMargin() + shape.getMargin();
  bool touches = false;
  for (int i = 0; i < soft.m_nodes.size(); ++i) {
    btSoftBody::Node& node = soft.m_nodes[i];
    NodeTrack& track = tracks_[static_cast<std::size_t>(i)];
    if (node.m_battach || !(node.m_im + carrier.inverseMass() > 0)) continue;
    const std::optional<NodeBarrier> barrier = search_.find(surface, startOf(node, track), now_.toTree(node.m_x),
                                                            static_cast<float>(margin / now_.scale), track);
    if (!barrier) continue;
    const btVector3 normal = now_.pose.getBasis() * bullet::toBtVector3(barrier->normal);
    const btScalar separation = btScalar(barrier->separation) * now_.scale - margin;
    soft.m_rcontacts.push_back(contactOf(soft, node, carrier, normal, separation));
    if (before_.tree != now_.tree) liftOut(node, normal, -separation);
    touches = true;
  }
  if (touches && carrier.rigid) carrier.rigid->activate();
}

}  // namespace cairn::soft
