// SPDX-License-Identifier: Zlib
#include "cairn/effects/forest_drag.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>

#include "ground_layer.h"

namespace cairn::effects {

std::uint32_t ForestDrag::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.coefficient > 0)) return 0;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    if (body.getLinearVelocity().fuzzyZero()) continue;
    const btVector3& place = body.getCenterOfMassPosition();
    if (!options_.region.contains(place.x(), place.y())) continue;
    if (!isInLayer(ground_, options_.height, place)) continue;
    body.setLinearVelocity(body.getLinearVelocity() *
                           std::exp(-options_.coefficient * body.getInvMass() * step.timeStep));
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
