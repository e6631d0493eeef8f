// SPDX-License-Identifier: Zlib
#include "cairn/effects/rolling_resistance.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include <limits>

namespace cairn::effects {

std::uint32_t RollingResistance::changeContacts(std::span<Contact> contacts, const Step& /*step*/) {
  std::uint32_t acted = 0;
  for (const Contact& contact : contacts) {
    const Lengths lengths = lengths_.at(contact.sides[0].material, contact.sides[1].material);
    if (!acts(lengths)) continue;
    // Bullet looks at spinning only where something rolls.
    const bool onlySpins = lengths.spinning > 0 && lengths.rolling <= 0;
    contact.point->m_combinedRollingFriction = onlySpins ? std::numeric_limits<btScalar>::min() : lengths.rolling;
    contact.point->m_combinedSpinningFriction = lengths.spinning;
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects
