// SPDX-License-Identifier: Zlib
#include "cairn/effects/water.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "quadratic_drag.h"

namespace cairn::effects {

btScalar Water::submergedFraction(btScalar radius, btScalar depth) {
  const btScalar height = std::clamp((depth + radius) / radius, btScalar(0), btScalar(2));  // of the cap, in radii
  return height * height * (3 - height) / 4;
}

std::uint32_t Water::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.density > 0)) return 0;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    const btVector3& place = body.getCenterOfMassPosition();
    if (place.z() - known->radius >= options_.level || known->radius <= 0) continue;
    if (!options_.region.contains(place.x(), place.y())) continue;
    const btScalar fraction = submergedFraction(known->radius, options_.level - place.z());
    const btScalar k =
        dragPerMetre(options_.density, options_.coefficient, known->radius, body.getInvMass()) * fraction;
    const btScalar lift = options_.density * known->traits.volume * fraction * body.getInvMass();
    body.setLinearVelocity(dragged(body.getLinearVelocity(), k, step.timeStep) - step.gravity * (lift * step.timeStep));
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
