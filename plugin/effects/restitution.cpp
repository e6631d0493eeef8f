// SPDX-License-Identifier: Zlib
#include "cairn/effects/restitution.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include "cairn/effects/effect_set.h"
#include "contacts/restitution.h"

namespace cairn::effects {
namespace restitution {
namespace {

struct At {
  btScalar value, speed;

  btScalar operator()(const Constant&) const { return value; }
  btScalar operator()(const Pfeiffer& law) const {
    const btScalar ratio = speed / law.halfSpeed;
    return value / (1 + ratio * ratio);
  }
  btScalar operator()(const Bourrier&) const { return value > 0 ? value / (speed + value) : btScalar(0); }
};

}  // namespace

btScalar at(const Law& law, btScalar value, btScalar closingSpeed) {
  return std::visit(At{value, closingSpeed}, law);
}

}  // namespace restitution

std::uint32_t Restitution::changeContacts(std::span<Contact> contacts, const Step& step) {
  std::uint32_t acted = 0;
  for (const Contact& contact : contacts) {
    btManifoldPoint& point = *contact.point;
    point.m_combinedRestitution = 0;
    if (contact.closingSpeed <= EffectSet::kImpactSpeed) continue;
    const btScalar value = values_.at(contact.sides[0].material, contact.sides[1].material);
    point.m_combinedRestitution = restitution::at(law_, value, contact.closingSpeed);
    point.m_distance1 =
        bullet::solverDistance(point.m_distance1, contact.closingSpeed, point.m_combinedRestitution, step.timeStep);
    if (point.m_combinedRestitution > 0) ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
