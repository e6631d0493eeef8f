// SPDX-License-Identifier: Zlib
#include "cairn/effects/ground_drag.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "ground_layer.h"

namespace cairn::effects {

std::uint32_t GroundDrag::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.deceleration > 0)) return 0;
  const btScalar belowSquare = options_.below * options_.below;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    const btVector3& velocity = body.getLinearVelocity();
    if (velocity.length2() >= belowSquare || velocity.fuzzyZero()) continue;
    const btVector3 underside = body.getCenterOfMassPosition() - btVector3(0, 0, known->radius);
    if (!isInLayer(ground_, options_.within, underside)) continue;
    const btScalar kept = 1 - options_.deceleration * step.timeStep / velocity.length();
    body.setLinearVelocity(velocity * std::max(btScalar(0), kept));
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
