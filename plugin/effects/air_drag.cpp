// SPDX-License-Identifier: Zlib
#include "cairn/effects/air_drag.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "quadratic_drag.h"

namespace cairn::effects {

std::uint32_t AirDrag::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.density * options_.coefficient > 0)) return 0;
  const btScalar leastSquare = options_.leastSpeed * options_.leastSpeed;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    const btVector3& velocity = body.getLinearVelocity();
    if (!(velocity.length2() > leastSquare) || known->radius <= 0) continue;
    const btScalar k = dragPerMetre(options_.density, options_.coefficient, known->radius, body.getInvMass());
    body.setLinearVelocity(dragged(velocity, k, step.timeStep));
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
