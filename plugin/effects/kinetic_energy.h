// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cairn::effects {

/// Of the centre of mass's motion, J.
inline btScalar translationalEnergy(const btRigidBody& body) {
  return btScalar(0.5) * body.getMass() * body.getLinearVelocity().length2();
}

/// Of the spin, J; axes that cannot turn have none.
inline btScalar rotationalEnergy(const btRigidBody& body) {
  const btVector3 spin = body.getAngularVelocity() * body.getCenterOfMassTransform().getBasis();  // in the body's axes
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  btScalar twice = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (inverse[axis] > 0) twice += spin[axis] * spin[axis] / inverse[axis];
  return btScalar(0.5) * twice;
}

}  // namespace cairn::effects
