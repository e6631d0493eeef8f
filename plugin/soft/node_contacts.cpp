// SPDX-License-Identifier: Zlib
#include "node_contacts.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

namespace cairn::soft {

namespace {

/// What Bullet asks in each step.
bool meetsNodes(const btSoftBody& soft) {
  return (soft.m_cfg.collisions & btSoftBody::fCollision::RVSmask) == btSoftBody::fCollision::SDF_RS;
}
bool isIgnored(const btSoftBody& soft, const btCollisionObject* object) {
  return soft.m_collisionDisabledObjects.findLinearSearch(object) != soft.m_collisionDisabledObjects.size();
}

}  // namespace

void NodeContacts::processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                                    const btDispatcherInfo& info, btManifoldResult* result) {
  const bool isSoftFirst = body0->getCollisionShape()->isSoftBody();
  const btCollisionObjectWrapper& other = *(isSoftFirst ? body1 : body0);
  // As Bullet's own algorithms for soft bodies do it, which write contacts into an object they were shown as constant.
  auto& soft = const_cast<btSoftBody&>(*btSoftBody::upcast((isSoftFirst ? body0 : body1)->getCollisionObject()));
  const bullet::SphereTreeShape* const shape = bullet::asSphereTree(other.getCollisionShape());
  const bool isBullets = !shape || !meetsNodes(soft);
  if (!isBullets && !isIgnored(soft, other.getCollisionObject())) {
    pair_->meet(soft, other, *shape);
    return;
  }
  *pair_ = {};  // its last step is no longer the last one
  if (isBullets) bullets_.process(body0, body1, info, result);
}

}  // namespace cairn::soft
