// SPDX-License-Identifier: Zlib
#include "cairn/effects/soil_scarring.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

#include "kinetic_energy.h"

namespace cairn::effects {

SoilScarring::Work SoilScarring::workOf(const Soil& soil, btScalar mass, btScalar radius, btScalar normalSpeed,
                                        btScalar speed) {
  if (!(soil.strength > 0)) return {0, 0};
  const btScalar free = btScalar(0.16) * std::sqrt(std::sqrt(mass)) * std::pow(soil.strength, btScalar(-0.4)) *
                        std::pow(normalSpeed, btScalar(0.8));
  const btScalar depth = std::min(free, radius);
  const btScalar section = SIMD_PI * (2 * radius - depth) * depth;
  return {depth, btScalar(0.5) * soil.drag * soil.density * section * speed * speed * depth};
}

bool SoilScarring::scar(const Impact& impact, std::size_t side) {
  const Side &mover = impact.sides[side], &ground = impact.sides[1 - side];
  if (mover.body == nullptr || !ground.object->isStaticOrKinematicObject() || !isSoil(ground.material)) return false;
  const btVector3& before = impact.linearBefore[side];
  const btScalar normalSpeed = impact.normal.dot(before) * (side == 0 ? btScalar(-1) : btScalar(1));
  if (normalSpeed <= 0 || mover.body->radius <= 0) return false;
  btRigidBody& body = *mover.body->body;
  const Work work = workOf(soils_[ground.material], body.getMass(), mover.body->radius, normalSpeed, before.length());
  const btScalar energy = translationalEnergy(body), loss = std::min(work.energy, energy);
  if (!(loss > 0)) return false;
  body.setLinearVelocity(body.getLinearVelocity() * std::sqrt(1 - loss / energy));
  scars_.add({impact.place, work.depth, loss, mover.body->id});
  return true;
}

std::uint32_t SoilScarring::afterImpacts(std::span<const Impact> impacts, const Step& /*step*/) {
  std::uint32_t acted = 0;
  for (const Impact& impact : impacts)
    for (std::size_t side = 0; side < 2; ++side)
      if (scar(impact, side)) ++acted;
  return acted;
}

}  // namespace cairn::effects
