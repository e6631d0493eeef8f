// SPDX-License-Identifier: Zlib
#include "cairn/effects/tangential_restitution.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cairn::effects {
namespace {

// Which side moves if only one does, else -1.
int movingSide(const std::array<Side, 2>& sides) {
  const bool first = !sides[0].object->isStaticOrKinematicObject(),
             second = !sides[1].object->isStaticOrKinematicObject();
  if (first == second) return -1;
  return first ? 0 : 1;
}

}  // namespace

std::uint32_t TangentialRestitution::changeContacts(std::span<Contact> contacts, const Step& /*step*/) {
  for (Contact& contact : contacts) {
    if (contact.impact < 0 || movingSide(contact.sides) < 0) continue;
    contact.point->m_combinedFriction = 0;
    contact.point->m_combinedRollingFriction = contact.point->m_combinedSpinningFriction = 0;
    contact.rollingLength = contact.spinningLength = 0;
  }
  return 0;  // the blows count, once they have come
}

std::uint32_t TangentialRestitution::afterImpacts(std::span<const Impact> impacts, const Step& /*step*/) {
  std::uint32_t acted = 0;
  for (const Impact& impact : impacts) {
    const int moving = movingSide(impact.sides);
    if (moving < 0) continue;
    const auto side = static_cast<std::size_t>(moving);
    if (impact.sides[side].body == nullptr) continue;
    btRigidBody& body = *impact.sides[side].body->body;
    const btScalar part = parts_.at(impact.sides[0].material, impact.sides[1].material);
    const auto along = [&](const btVector3& v) { return v - impact.normal * impact.normal.dot(v); };
    const btVector3 now = body.getLinearVelocity();
    // What other contacts took of it in the meantime stays taken.
    const btVector3 before = along(impact.linearBefore[side]), after = along(now);
    const btVector3 kept = after.length2() < before.length2() ? after : before;
    body.setLinearVelocity(now - after + kept * part);
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
