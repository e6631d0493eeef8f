// SPDX-License-Identifier: Zlib
#include "cairn/effects/effect.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>

namespace cairn::effects {

Body::Body(btRigidBody* rigidBody, const Traits& itsTraits, std::uint32_t itsId)
    : body(rigidBody), traits(itsTraits), id(itsId), radius(std::cbrt(itsTraits.volume * btScalar(0.75) / SIMD_PI)) {}

btScalar Impact::energy() const {
  btScalar inverseMass = 0;
  for (const Side& side : sides)
    if (const btRigidBody* body = btRigidBody::upcast(side.object)) inverseMass += body->getInvMass();
  return inverseMass > 0 ? btScalar(0.5) * closingSpeed * closingSpeed / inverseMass : btScalar(0);
}

}  // namespace cairn::effects
