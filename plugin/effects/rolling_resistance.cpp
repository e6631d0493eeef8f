// SPDX-License-Identifier: Zlib
#include "cairn/effects/rolling_resistance.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

namespace cairn::effects {

std::uint32_t RollingResistance::changeContacts(std::span<Contact> contacts, const Step& /*step*/) {
  std::uint32_t acted = 0;
  for (Contact& contact : contacts) {
    const Lengths lengths = lengths_.at(contact.sides[0].material, contact.sides[1].material);
    if (!acts(lengths)) continue;
    contact.point->m_combinedRollingFriction = contact.point->m_combinedSpinningFriction = 0;
    contact.rollingLength = lengths.rolling;
    contact.spinningLength = lengths.spinning;
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
