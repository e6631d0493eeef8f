// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cairn::effects {

/// Velocity of an object's matter at a place, world frame; zero for what is no rigid body.
inline btVector3 velocityAt(const btCollisionObject& object, const btVector3& place) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  return body == nullptr ? btVector3(0, 0, 0) : body->getVelocityInLocalPoint(place - body->getCenterOfMassPosition());
}

}  // namespace cairn::effects
