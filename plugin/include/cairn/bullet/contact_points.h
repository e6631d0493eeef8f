// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

namespace cairn::bullet {

/// Flag in `m_contactPointFlags`: the point is a guard. Bullet's own flags end at bit 4; Cairn's are bits 27 to 30
/// (`PairAnswers.AreGuardsOnABudgetAlone`).
inline constexpr int kGuardFlag = 1 << 29;

/// Whether a manifold's point is a guard: a bound between two spheres, which stands for a pair that had too little
/// budget, or was finished over several steps. The surfaces may not touch at all there. Sounds, damage and footsteps
/// should leave guards out:
///
///     for (int i = 0; i < manifold.getNumContacts(); ++i)
///       if (!cairn::bullet::isGuard(manifold.getContactPoint(i))) hit(manifold.getContactPoint(i).m_appliedImpulse);
///
/// Guards of a locked pair may point both ways, and their `m_combinedFriction` is 10. Valid after the pass; a callback
/// that sees a new point (`gContactAddedCallback`) is called before the flag is set. Without a budget there are none.
inline bool isGuard(const btManifoldPoint& point) {
  return (point.m_contactPointFlags & kGuardFlag) != 0;
}

}  // namespace cairn::bullet
