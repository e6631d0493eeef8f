// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

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

/// Takes energy of all motion, J, or all there is: velocities are scaled down in their directions. Precondition: loss >
/// 0.
inline void loseEnergy(btRigidBody& body, btScalar loss) {
  const btScalar energy = translationalEnergy(body) + rotationalEnergy(body);
  if (!(energy > 0)) return;
  const btScalar kept = std::sqrt(std::max(btScalar(0), 1 - loss / energy));
  body.setLinearVelocity(body.getLinearVelocity() * kept);
  body.setAngularVelocity(body.getAngularVelocity() * kept);
}

}  // namespace cairn::effects
