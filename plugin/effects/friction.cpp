// SPDX-License-Identifier: Zlib
#include "cairn/effects/friction.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

namespace cairn::effects {

std::uint32_t Friction::changeContacts(std::span<Contact> contacts, const Step& /*step*/) {
  for (Contact& contact : contacts) {
    const btScalar coefficient = coefficients_.at(contact.sides[0].material, contact.sides[1].material);
    contact.point->m_combinedFriction = coefficient;
    contact.ordersBlow = contact.ordersBlow || coefficient > 0;
  }
  return static_cast<std::uint32_t>(contacts.size());
}

}  // namespace cairn::effects
